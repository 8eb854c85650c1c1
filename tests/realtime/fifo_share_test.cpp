// A priority that a thread has for a share of the time.

#include <chrono>

#include <gtest/gtest.h>

#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::realtime {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr milliseconds kStart{1000};  // the clock shows anything, and the thread has computed before
constexpr milliseconds kComputed{70};

TEST(TimeBudget, IsExceededByComputingBeyondTheShareOfAWindow) {
  TimeBudget budget({.share = 0.4, .window = milliseconds(10)});
  EXPECT_TRUE(budget.is_within(kStart, kComputed));
  EXPECT_TRUE(budget.is_within(kStart + milliseconds(4), kComputed + milliseconds(4)));
  EXPECT_FALSE(budget.is_within(kStart + milliseconds(5), kComputed + microseconds(4001)));
  EXPECT_FALSE(budget.is_within(kStart + microseconds(9999), kComputed + microseconds(4001)));
}

// A link that has waited sends all at once. It keeps its priority, and loses it only if it goes on like this.
TEST(TimeBudget, OfALinkLastsForABurstAndBeginsAnewAfter100Milliseconds) {
  TimeBudget budget(kLinkShare);
  EXPECT_TRUE(budget.is_within(kStart, kComputed));
  EXPECT_TRUE(budget.is_within(kStart + milliseconds(14), kComputed + milliseconds(14)));
  EXPECT_FALSE(budget.is_within(kStart + milliseconds(99), kComputed + milliseconds(16)));
  EXPECT_TRUE(budget.is_within(kStart + milliseconds(100), kComputed + milliseconds(17)));
  EXPECT_TRUE(budget.is_within(kStart + milliseconds(114), kComputed + milliseconds(31)));
}

TEST(TimeBudget, OfAThreadThatComputesLittleIsNeverUsedUp) {
  TimeBudget budget({.share = 0.4, .window = milliseconds(10)});
  for (int tick = 0; tick < 1000; ++tick)
    EXPECT_TRUE(budget.is_within(kStart + milliseconds(tick), kComputed + microseconds(350 * tick))) << tick;
}

/// Ticks of a thread with priority 2 that each compute for `time`: how many of them begin with it.
int ticks_ahead(milliseconds time, double share, int ticks) {
  SteadyClock clock;
  int ahead = 0;
  PeriodicThread thread(clock, {.period = milliseconds(1), .fifo_priority = 2, .fifo_share = {share, milliseconds(10)}},
                        [&](const PeriodicTick& tick) {
                          ahead += fifo_priority_of_this_thread() == 2 ? 1 : 0;
                          clock.spin_until(clock.now() + time);
                          return static_cast<int>(tick.index) + 1 < ticks;
                        });
  thread.join();
  return thread.scheduling().is_fifo ? ahead : -1;
}

TEST(PeriodicThread, KeepsItsPriorityForAShareOfTheTime) {
  const int for_good = ticks_ahead(milliseconds(2), 1.0, 40);
  if (for_good < 0) GTEST_SKIP() << "SCHED_FIFO is not granted";
  EXPECT_EQ(for_good, 40);
  // However busy the machine is: in a window, the third tick of 2 ms is the last one that can begin with the priority.
  const int for_a_share = ticks_ahead(milliseconds(2), 0.3, 40);
  EXPECT_GE(for_a_share, 8);
  EXPECT_LT(for_a_share, 40);
}

}  // namespace
}  // namespace glissade::realtime

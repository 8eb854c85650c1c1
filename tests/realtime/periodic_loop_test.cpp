#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <pthread.h>

#include <glissade/realtime/periodic_loop.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::realtime {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// Runs one tick per entry of `durations` on a simulated clock; returns the starts in microseconds.
std::vector<std::int64_t> starts_us(const std::vector<microseconds>& durations, PeriodicStatistics& statistics) {
  SimulatedClock clock;
  std::vector<std::int64_t> starts;
  run_periodic(clock, milliseconds(1), statistics, [&](const PeriodicTick& tick) {
    starts.push_back(std::chrono::duration_cast<microseconds>(tick.start).count());
    clock.advance(durations[tick.index]);
    return tick.index + 1 < durations.size();
  });
  return starts;
}

/// A machine that wakes up `lateness` after every deadline.
class SluggishClock final : public Clock {
 public:
  explicit SluggishClock(nanoseconds lateness) : lateness_(lateness) {}
  nanoseconds now() const noexcept override { return now_; }
  void sleep_until(nanoseconds deadline) noexcept override {
    if (deadline > now_) now_ = deadline + lateness_;
  }

 private:
  nanoseconds lateness_;
  nanoseconds now_{0};
};

void run_empty_ticks(Clock& clock, std::uint64_t ticks, PeriodicStatistics& statistics) {
  run_periodic(clock, milliseconds(1), statistics,
               [ticks](const PeriodicTick& tick) { return tick.index + 1 < ticks; });
}

TEST(RunPeriodic, KeepsTheRateWhateverTheTicksTake) {
  PeriodicStatistics statistics;
  const auto starts = starts_us({microseconds(0), microseconds(300), microseconds(999), microseconds(10)}, statistics);
  EXPECT_EQ(starts, (std::vector<std::int64_t>{1000, 2000, 3000, 4000}));
  EXPECT_EQ(statistics.ticks, 4U);
  EXPECT_EQ(statistics.late_ticks, 0U);
  EXPECT_EQ(statistics.skipped_deadlines, 0U);
  EXPECT_EQ(statistics.lateness.max(), nanoseconds(0));
  EXPECT_EQ(statistics.duration.max(), microseconds(999));
}

TEST(RunPeriodic, AShortOverrunDelaysOnlyTheNextTick) {
  PeriodicStatistics statistics;
  const auto starts = starts_us({microseconds(1400), microseconds(100), microseconds(100)}, statistics);
  EXPECT_EQ(starts, (std::vector<std::int64_t>{1000, 2400, 3000}));
  EXPECT_EQ(statistics.lateness.max(), microseconds(400));
  EXPECT_EQ(statistics.late_ticks, 0U);
  EXPECT_EQ(statistics.skipped_deadlines, 0U);
}

TEST(RunPeriodic, ALongOverrunSkipsDeadlinesInsteadOfBunchingUp) {
  PeriodicStatistics statistics;
  const auto starts = starts_us({microseconds(4300), microseconds(100), microseconds(100)}, statistics);
  // Deadlines 2000, 3000 and 4000 are over by 5300; the period of 5000 is not.
  EXPECT_EQ(starts, (std::vector<std::int64_t>{1000, 5300, 6000}));
  EXPECT_EQ(statistics.skipped_deadlines, 3U);
  EXPECT_EQ(statistics.late_ticks, 0U);
}

TEST(RunPeriodic, WakingUpAPeriodAfterTheDeadlineIsLate) {
  for (const auto& [lateness, late_ticks] : {std::pair(microseconds(999), 0U), std::pair(microseconds(1000), 3U)}) {
    SluggishClock clock(lateness);
    PeriodicStatistics statistics;
    run_empty_ticks(clock, 5, statistics);
    EXPECT_EQ(statistics.ticks, 5U);
    // After a late tick the next deadline has come already: that tick needs no sleep and is on time.
    EXPECT_EQ(statistics.late_ticks, late_ticks) << lateness.count();
    EXPECT_EQ(statistics.lateness.max(), lateness);
  }
}

/// Wakes up `lateness` after every deadline, but reads the time without delay.
class SpinningClock final : public Clock {
 public:
  explicit SpinningClock(nanoseconds lateness) : lateness_(lateness) {}
  nanoseconds now() const noexcept override { return now_; }
  void sleep_until(nanoseconds deadline) noexcept override {
    if (deadline > now_) now_ = deadline + lateness_;
  }
  void spin_until(nanoseconds deadline) noexcept override {
    if (deadline <= now_) return;
    spun_ += deadline - now_;
    now_ = deadline;
  }
  nanoseconds spun() const { return spun_; }

 private:
  nanoseconds lateness_;
  nanoseconds now_{0};
  nanoseconds spun_{0};
};

TEST(RunPeriodic, SpinningAbsorbsWakeUpLatenessUpToItsTime) {
  const auto stop_after_ten = [](const PeriodicTick& tick) { return tick.index < 9; };
  for (const auto& [lateness, left] : {std::pair(60, 0), std::pair(100, 0), std::pair(150, 50)}) {
    SpinningClock clock{microseconds(lateness)};
    PeriodicStatistics statistics;
    run_periodic(clock, milliseconds(1), statistics, stop_after_ten, microseconds(100));
    EXPECT_EQ(statistics.lateness.max(), microseconds(left)) << lateness;
    EXPECT_EQ(clock.spun(), 10 * microseconds(std::max(0, 100 - lateness)));
    EXPECT_EQ(clock.now(), milliseconds(10) + microseconds(left));
  }
}

TEST(RunPeriodic, SpinningOnASimulatedClockChangesNothing) {
  SimulatedClock clock;
  PeriodicStatistics statistics;
  run_periodic(
      clock, milliseconds(1), statistics, [](const PeriodicTick& tick) { return tick.index < 9; }, microseconds(500));
  EXPECT_EQ(clock.now(), milliseconds(10));
  EXPECT_EQ(statistics.lateness.max(), nanoseconds(0));
}

TEST(RunPeriodic, RefusesToSpinForMoreThanHalfOfThePeriod) {
  SimulatedClock clock;
  PeriodicStatistics statistics;
  const auto stop_at_once = [](const PeriodicTick&) { return false; };
  for (const microseconds spin : {microseconds(-1), microseconds(501)}) {
    EXPECT_THROW(run_periodic(clock, milliseconds(1), statistics, stop_at_once, spin), std::invalid_argument);
    EXPECT_THROW(PeriodicThread(clock, {.spin = spin}, stop_at_once), std::invalid_argument);
  }
}

TEST(RunPeriodic, StatisticsOfConsecutiveRunsAddUp) {
  SimulatedClock clock;
  PeriodicStatistics statistics;
  run_empty_ticks(clock, 3, statistics);
  run_empty_ticks(clock, 4, statistics);
  EXPECT_EQ(statistics.ticks, 7U);
  EXPECT_EQ(clock.now(), milliseconds(7));
}

TEST(RunPeriodic, RefusesAPeriodThatIsNotPositive) {
  SimulatedClock clock;
  PeriodicStatistics statistics;
  const auto stop_at_once = [](const PeriodicTick&) { return false; };
  EXPECT_THROW(run_periodic(clock, nanoseconds(0), statistics, stop_at_once), std::invalid_argument);
  EXPECT_THROW(PeriodicThread(clock, {.period = nanoseconds(-1)}, stop_at_once), std::invalid_argument);
}

TEST(PeriodicThread, NeedsATick) {
  SteadyClock clock;
  EXPECT_THROW(PeriodicThread(clock, {}, {}), std::invalid_argument);
}

TEST(PeriodicThread, RunsUntilTheTickSaysSo) {
  SteadyClock clock;
  std::uint64_t calls = 0;
  PeriodicThread thread(clock, {.period = microseconds(500)}, [&calls](const PeriodicTick&) { return ++calls < 10; });
  thread.join();
  EXPECT_EQ(calls, 10U);
  EXPECT_EQ(thread.statistics().ticks, 10U);
  EXPECT_FALSE(thread.scheduling().is_fifo);
  EXPECT_TRUE(thread.scheduling().has_minimal_timer_slack);
}

TEST(PeriodicThread, SpinsIfItIsTold) {
  SpinningClock clock{microseconds(60)};
  PeriodicThread thread(clock, {.spin = microseconds(100)}, [](const PeriodicTick& tick) { return tick.index < 9; });
  thread.join();
  EXPECT_EQ(clock.spun(), 10 * microseconds(40));
}

TEST(PeriodicThread, NameIsTruncatedTo15Characters) {
  SteadyClock clock;
  std::array<char, 16> name{};
  PeriodicThread thread(clock, {.name = "a name that is too long"}, [&name](const PeriodicTick&) {
    pthread_getname_np(pthread_self(), name.data(), name.size());
    return false;
  });
  thread.join();
  EXPECT_STREQ(name.data(), "a name that is ");
}

TEST(PeriodicThread, StopsWhenAskedTo) {
  SteadyClock clock;
  PeriodicThread thread(clock, {.period = milliseconds(1), .fifo_priority = 1},
                        [](const PeriodicTick&) { return true; });
  thread.stop();
  EXPECT_LE(thread.statistics().late_ticks, thread.statistics().ticks);
}

TEST(SteadyClock, SpinsUntilTheDeadline) {
  SteadyClock clock;
  const nanoseconds before = clock.now();
  clock.spin_until(before - milliseconds(10));
  clock.spin_until(before + microseconds(300));
  EXPECT_GE(clock.now(), before + microseconds(300));
}

TEST(SteadyClock, SleepsUntilTheDeadlineAndNotBelow) {
  SteadyClock clock;
  const nanoseconds before = clock.now();
  clock.sleep_until(before - milliseconds(10));
  clock.sleep_until(nanoseconds(-1));
  clock.sleep_until(before + milliseconds(2));
  EXPECT_GE(clock.now(), before + milliseconds(2));
}

}  // namespace
}  // namespace glissade::realtime

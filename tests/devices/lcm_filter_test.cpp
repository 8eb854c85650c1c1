/// Which messages are refused for their sender or their sequence.

#include <chrono>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

#include "glove_link_fixture.h"
#include "lcm/link_monitor.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

TEST_F(LcmLink, SequencesMustRiseAndGapsAreCounted) {
  EXPECT_EQ(after(encoded(good_state(10))).accepted, 1U);
  EXPECT_EQ(after(encoded(good_state(10))).out_of_sequence, 1U);
  EXPECT_EQ(after(encoded(good_state(9))).out_of_sequence, 2U);
  EXPECT_EQ(after(encoded(good_state(11))).lost, 0U);
  EXPECT_EQ(after(encoded(good_state(15))).lost, 3U);
  GloveState state;
  ASSERT_TRUE(glove.read(state));
  EXPECT_EQ(state.sequence, 15);
}

TEST_F(LcmLink, SequencesCannotAdvanceBeyond20000PerSecond) {
  const auto begin = std::chrono::steady_clock::now();  // no later than the link's own first reading of the time
  EXPECT_EQ(after(encoded(good_state(1))).accepted, 1U);
  std::int64_t accepted = 1;
  for (int i = 0; i < 200; ++i) {
    if (after(encoded(good_state(accepted + 50))).accepted == 2U + static_cast<std::uint64_t>(accepted / 50))
      accepted += 50;
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(static_cast<double>(accepted), 52.0 + 20e3 * passed.count());
}

TEST_F(LcmLink, FallingSequencesAreNeverAccepted) {
  EXPECT_EQ(after(encoded(good_state(1000))).accepted, 1U);
  for (std::int64_t sequence = 999; sequence > 900; --sequence)
    EXPECT_EQ(after(encoded(good_state(sequence))).accepted, 1U);
}

TEST_F(LcmLink, OneHugeSequenceDoesNotLockTheSenderOut) {
  EXPECT_EQ(after(encoded(good_state(10))).accepted, 1U);
  EXPECT_EQ(after(encoded(good_state(kLargest))).out_of_sequence, 1U);
  EXPECT_EQ(after(encoded(good_state(11))).accepted, 2U);
}

TEST_F(LcmLink, GrantedLeaseRefusesOtherSessions) {
  const LcmGlove granted(bus, descriptor, {.glove_session = 2});
  bus->publish("GLOVE_STATE", encoded(good_state(10)));  // of session 1
  ASSERT_TRUE(eventually([&] { return granted.statistics().other_sender == 1; }));
  glove_state_t announced = good_state(1);
  announced.session = 2;
  bus->publish("GLOVE_STATE", encoded(announced));
  EXPECT_TRUE(eventually([&] { return granted.statistics().accepted == 1; }));
}

/// A filter with a lease of 500 ms, and messages of one session.
class Filter : public testing::Test {
 protected:
  bool admits(std::int64_t sequence, milliseconds now) {
    return monitor_.admit(MessageError::kNone, {1, 7, sequence}, now);
  }
  LinkMonitor monitor_{milliseconds(500)};
};

TEST_F(Filter, AForgedNumberAfterASilenceIsRefused) {
  EXPECT_TRUE(admits(10, milliseconds(0)));
  EXPECT_FALSE(admits(8000, milliseconds(400)));
  EXPECT_TRUE(admits(411, milliseconds(401)));
}

TEST_F(Filter, ALockedOutSenderStartsAnewAfterOneLease) {
  EXPECT_TRUE(admits(10, milliseconds(0)));
  EXPECT_TRUE(admits(2000, milliseconds(400))) << "forged";
  std::int64_t sequence = 411;
  milliseconds now(401);
  while (!admits(sequence, now)) {
    ASSERT_LT(now, milliseconds(1000));
    ++sequence;
    ++now;
  }
  EXPECT_LE(now, milliseconds(902));
  EXPECT_TRUE(admits(sequence + 1, now));
  EXPECT_EQ(monitor_.statistics().lost, 1989U) << "only those before the forged one seem lost";
}

TEST_F(Filter, FallingNumbersAreNoNewStart) {
  EXPECT_TRUE(admits(10'000, milliseconds(0)));
  for (int i = 1; i < 5000; ++i)
    ASSERT_FALSE(admits(10'000 - i, milliseconds(i)));
}

TEST_F(Filter, ASenderThatWasSilentForLongIsHeardAgain) {
  EXPECT_TRUE(admits(10, milliseconds(0)));
  EXPECT_FALSE(admits(60'000, milliseconds(60'000)));
  EXPECT_TRUE(admits(60'001, milliseconds(60'001)));
}

TEST(LcmGlove, AcceptsARestartedGloveAfterASilence) {
  const auto bus = std::make_shared<LcmBus>("memq://");
  LcmGlove glove(bus, simulated_glove_descriptor(), {.lease = milliseconds(30)});
  bus->publish("GLOVE_STATE", encoded(good_state(1'000'000)));
  ASSERT_TRUE(eventually([&] { return glove.statistics().accepted == 1; }));
  glove_state_t restarted = good_state(0);
  restarted.session = 2;
  std::this_thread::sleep_for(milliseconds(60));
  bus->publish("GLOVE_STATE", encoded(restarted));
  EXPECT_TRUE(eventually([&] { return glove.statistics().accepted == 2; }));
  EXPECT_EQ(glove.statistics().lost, 0U);
}

}  // namespace
}  // namespace glissade::devices

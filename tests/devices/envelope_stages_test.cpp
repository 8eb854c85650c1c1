/// The stages of the safety envelope, one by one.

#include <chrono>
#include <functional>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>

#include "envelope/fade.h"
#include "envelope/link_delay.h"
#include "envelope/simple_limits.h"
#include "envelope/strokes.h"
#include "envelope/supply.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

const DeviceDescriptor kGlove = simulated_glove_descriptor();  // 20 N, 1 Nm, 1000 Hz

Forces along_x(double newtons) {
  Forces forces;
  forces.f.x() = newtons;
  return forces;
}

Eigen::Isometry3d at_x(double x) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

TEST(PoseInPlay, FollowsBeyondFourTimesTheResolution) {
  PoseInPlay pose(1e-3, 0.5);
  pose.start_at(at_x(0.1));
  EXPECT_EQ(pose.follow(at_x(0.1039)).v.x(), 0.0);
  EXPECT_NEAR(pose.follow(at_x(0.110)).v.x(), 0.006, 1e-12);
  EXPECT_EQ(pose.follow(at_x(0.103)).v.x(), 0.0) << "8 mm of play";
  EXPECT_NEAR(pose.follow(at_x(0.100)).v.x(), -0.002, 1e-12);
  const Eigen::Isometry3d turned = at_x(0.1) * Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(pose.follow(turned).w.z(), 0.05 - 0.04, 1e-4) << "4 mm at 0.1 m";
}

/// 20 N push along x while the hand moves by so much in a millisecond, again and again.
class PushedHand {
 public:
  void move(double way) {
    BookedMotion motion{state_, state_, now_, now_ + milliseconds(1), false};
    motion.to.time = now_ += milliseconds(1);
    motion.to.X_WH.translation().x() += way;
    given_.give(motion.begin, {20.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
    strokes_.observe(motion, given_);
    strokes_.forget(1e-3);
    state_ = motion.to;
  }
  double calm() const { return strokes_.calm(); }

 private:
  GivenWrenches given_{milliseconds(0), milliseconds(10)};
  Strokes strokes_{1e-4, 20.0};
  GloveState state_;
  std::chrono::nanoseconds now_{0};
};

TEST(PoseInPlay, PlayIsAtMost5MillijoulesAtMaximumForce) {
  PoseInPlay pose(1e-3, 20.0);
  pose.start_at(at_x(0.0));
  EXPECT_NEAR(pose.follow(at_x(1e-3)).v.x(), 0.75e-3, 1e-12);
}

TEST(Strokes, NoiseCountsAsCalm) {
  PushedHand hand;
  for (int ms = 0; ms < 1000; ++ms)
    hand.move(ms % 2 == 0 ? 2e-4 : -2e-4);
  EXPECT_EQ(hand.calm(), 1.0);
}

TEST(Strokes, OscillationIsNotCalmButALiftIs) {
  PushedHand rubbed;
  PushedHand lifted;
  for (int ms = 0; ms < 2000; ++ms) {
    rubbed.move(ms % 200 < 100 ? 2e-5 : -2e-5);  // 2 mm each way
    lifted.move(1e-4);
  }
  EXPECT_EQ(rubbed.calm(), 0.0);
  EXPECT_EQ(lifted.calm(), 1.0) << "as a force that comes back does";
}

TEST(Supply, RequestedEnergyIsGivenUpAndTheRestExpires) {
  Supply supply;
  GloveCommand command;
  const auto take = [&](double told) {
    ++command.sequence;
    command.supply = told;
    return supply.take(command, false, 5.0, 50.0, 1e-3);
  };
  supply.observe_given(along_x(20.0), along_x(10.0), kGlove);
  EXPECT_EQ(take(0.0), 0.0);
  EXPECT_DOUBLE_EQ(take(0.01), 0.005) << "half of the force was given";
  EXPECT_EQ(take(-0.99), 0.0);
  EXPECT_DOUBLE_EQ(supply.give_up(0.4, 1e-3), 0.4);
  EXPECT_DOUBLE_EQ(supply.taken(), 0.4);
  EXPECT_EQ(take(-0.95), 0.0) << "less is asked for";
  EXPECT_NEAR(supply.give_up(5.0, 10.0), 0.6 * (1.0 - 1e-3) - 0.02, 1e-12);
  EXPECT_EQ(supply.give_up(5.0, 1e-3), 0.0);
}

TEST(Fade, TakesSevenPeriodsAndReturnsIn200Milliseconds) {
  Fade fade(kGlove, 1e-3);
  for (int ms = 0; ms < 199; ++ms)
    fade.advance(false, 1e-3);
  EXPECT_FALSE(fade.is_whole());
  fade.advance(false, 1.5e-3);
  EXPECT_EQ(fade.returning(along_x(14.0)).f.x(), 14.0);
  Forces forces = along_x(14.0);
  int periods = 0;
  for (; forces.has_wrench(); ++periods)
    forces = fade.fading(forces, 1e-3);
  EXPECT_EQ(periods, 5) << "20 N take seven";
}

TEST(RateLimit, MaximumForceFallsToZeroWithin15Periods) {
  DeviceDescriptor slow = kGlove;
  slow.max_force_rate = 1000.0;
  const RateLimit rates(slow, 1e-3);
  EXPECT_DOUBLE_EQ(rates.max_force(), 15.0);
  EXPECT_DOUBLE_EQ(rates.time_to_zero(along_x(10.0)), 0.01);
  Forces forces = along_x(20.0);
  LimitReasons reasons;
  rates.limit(forces, along_x(5.0), 1e-3, reasons);
  EXPECT_DOUBLE_EQ(forces.f.x(), 6.0);
  EXPECT_TRUE(reasons.rate_limited);
}

/// Seconds of ages, one a millisecond.
void observe(LinkDelay& delay, double seconds, const std::function<milliseconds(int)>& age) {
  for (int ms = 0; ms < static_cast<int>(1000.0 * seconds); ++ms)
    delay.observe(age(ms), 1e-3);
}

TEST(LinkDelay, IsThatOfASteadyLinkAndIgnoresSilence) {
  LinkDelay delay(1e-3);
  observe(delay, 2.0, [](int) { return milliseconds(20); });
  EXPECT_EQ(delay.upper_quartile(), milliseconds(20));
  observe(delay, 1.0, [](int) { return milliseconds(200); });
  EXPECT_EQ(delay.upper_quartile(), milliseconds(20));
}

// Until then, no force acts.
TEST(LinkDelay, IsFoundFasterAtFirst) {
  LinkDelay delay(1e-3);
  observe(delay, 0.4, [](int) { return milliseconds(100); });
  EXPECT_EQ(delay.upper_quartile(), milliseconds(100));
  observe(delay, 4.0, [](int) { return milliseconds(1); });
  EXPECT_LE(delay.upper_quartile(), milliseconds(2));
  observe(delay, 0.4, [](int) { return milliseconds(100); });
  EXPECT_LE(delay.upper_quartile(), milliseconds(15));
}

TEST(LinkDelay, StandsStillWhileSomeCommandsComeEarlyOrLate) {
  LinkDelay delay(1e-3);
  observe(delay, 1.0, [](int) { return milliseconds(2); });
  for (int second = 0; second < 10; ++second) {
    observe(delay, 1.0, [](int ms) { return milliseconds(ms % 10 == 0 ? 0 : ms % 10 == 5 ? 30 : 2); });
    EXPECT_NEAR(1e-6 * static_cast<double>(delay.upper_quartile().count()), 2.0, 0.02);
  }
}

TEST(LinkDelay, IsThatOfTheLaterHalfWhereAgesAlternate) {
  LinkDelay delay(1e-3);
  observe(delay, 20.0, [](int ms) { return milliseconds(ms % 2 == 0 ? 1 : 4); });
  EXPECT_NEAR(1e-6 * static_cast<double>(delay.upper_quartile().count()), 4.0, 0.02);
}

TEST(LinkDelay, ChangesTheLagOfASpringByLessThanAPercentInAPeriod) {
  for (const double period_s : {1e-3, 10e-3}) {
    LinkDelay delay(period_s);
    delay.observe(milliseconds(0), period_s);
    double lag_s = 0.5 * period_s;
    for (int i = 0; i < 1000; ++i) {
      delay.observe(milliseconds(i < 500 ? 100 : 0), period_s);
      const double now_s = 0.5 * period_s + std::chrono::duration<double>(delay.upper_quartile()).count();
      ASSERT_NEAR(now_s / lag_s, 1.0, 0.01) << i;
      lag_s = now_s;
    }
  }
}

}  // namespace
}  // namespace glissade::devices

/// The stages of the safety envelope, one by one.

#include <chrono>

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
  EXPECT_EQ(pose.follow(at_x(0.1039)).way.x(), 0.0);
  EXPECT_NEAR(pose.follow(at_x(0.110)).way.x(), 0.006, 1e-12);
  EXPECT_EQ(pose.follow(at_x(0.103)).way.x(), 0.0) << "8 mm of play";
  EXPECT_NEAR(pose.follow(at_x(0.100)).way.x(), -0.002, 1e-12);
  const Eigen::Isometry3d turned = at_x(0.1) * Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(pose.follow(turned).turn.z(), 0.05 - 0.04, 1e-4) << "4 mm at 0.1 m";
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
  EXPECT_NEAR(pose.follow(at_x(1e-3)).way.x(), 0.75e-3, 1e-12);
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

TEST(LinkDelay, IsTheSmallestAgeOfHalfASecondAndIgnoresSilence) {
  LinkDelay delay;
  const auto observe = [&](int from_ms, int until_ms, milliseconds age) {
    for (int ms = from_ms; ms < until_ms; ++ms)
      delay.observe(age, milliseconds(ms));
  };
  observe(1000, 1400, milliseconds(20));
  EXPECT_EQ(delay.least(), milliseconds(0)) << "not yet known";
  observe(1400, 2600, milliseconds(20));
  EXPECT_EQ(delay.least(), milliseconds(20));
  observe(2600, 4000, milliseconds(200));
  EXPECT_EQ(delay.least(), milliseconds(0));
}

}  // namespace
}  // namespace glissade::devices

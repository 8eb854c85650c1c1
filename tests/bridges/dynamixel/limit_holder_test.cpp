#include "dynamixel/limit_holder.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace glissade::bridges::dynamixel {
namespace {

constexpr double kPlay_rad = 0.006;
const devices::JointLimit kClosed{.upper = 0.5, .stiffness = 2.0, .max_torque = 0.1};

TEST(LimitHolder, FarInsideTheTorqueIsOff) {
  LimitHolder holder(kPlay_rad);
  EXPECT_EQ(holder.update(kClosed, 0.2), HoldGoal{});
}

TEST(LimitHolder, NearTheLimitTheServoIsReadyWithoutTorque) {
  LimitHolder holder(kPlay_rad);
  EXPECT_EQ(holder.update(kClosed, 0.47),
            (HoldGoal{.has_torque = true, .angle = 0.5, .max_torque = 0.0, .stiffness = 2.0}));
}

TEST(LimitHolder, AtTheLimitTheServoHoldsIt) {
  LimitHolder holder(kPlay_rad);
  const HoldGoal held{.has_torque = true, .angle = 0.5, .max_torque = 0.1, .stiffness = 2.0};
  EXPECT_EQ(holder.update(kClosed, 0.499), held);
  EXPECT_EQ(holder.update(kClosed, 0.8), held);
}

TEST(LimitHolder, LowerLimitsAreHeldToo) {
  LimitHolder holder(kPlay_rad);
  const devices::JointLimit limit{.lower = -0.1, .upper = 0.5, .stiffness = 2.0, .max_torque = 0.1};
  EXPECT_EQ(holder.update(limit, -0.15).angle, -0.1);
  EXPECT_EQ(holder.update(limit, 0.55).angle, 0.5);
  EXPECT_FALSE(holder.update(limit, 0.2).has_torque);
}

TEST(LimitHolder, NoLimitNoTorque) {
  LimitHolder holder(kPlay_rad);
  EXPECT_TRUE(holder.update(kClosed, 0.6).has_torque);
  EXPECT_EQ(holder.update({}, 0.6), HoldGoal{});
  EXPECT_EQ(holder.update(kClosed, std::numeric_limits<double>::quiet_NaN()), HoldGoal{});
}

TEST(LimitHolder, TremblingAtAThresholdSwitchesNothing) {
  // Thresholds, as distances inside the limit: half the play, the play, and the two angles beyond it.
  for (const double threshold : {0.5 * kPlay_rad, kPlay_rad, 0.0524 + kPlay_rad, 0.0873 + kPlay_rad}) {
    LimitHolder holder(kPlay_rad);
    holder.update(kClosed, 0.0);
    int changes = -1;  // the first time is none
    HoldGoal last{.angle = -1.0};
    for (int period = 0; period < 100; ++period) {
      const HoldGoal goal = holder.update(kClosed, 0.5 - threshold + (period % 2 == 0 ? 1e-3 : -1e-3));
      changes += goal == last ? 0 : 1;
      last = goal;
    }
    EXPECT_LE(changes, 1) << threshold;
  }
}

TEST(LimitHolder, TorqueChangesByNoMoreThanStiffnessTimesPlay) {
  // The servo's law in the whole range, for a finger that goes in and out.
  const auto torque = [](const HoldGoal& goal, double angle) {
    const double wanted = goal.stiffness * (goal.angle - angle);
    return goal.has_torque ? std::clamp(wanted, -goal.max_torque, goal.max_torque) : 0.0;
  };
  LimitHolder holder(kPlay_rad);
  double last = 0.0;
  for (int i = 0; i <= 20000; ++i) {
    const double angle = 0.45 + 0.1 * std::sin(0.001 * i);
    const double now = torque(holder.update(kClosed, angle), angle);
    EXPECT_LE(std::abs(now - last), kClosed.stiffness * kPlay_rad + 3e-4) << angle;
    EXPECT_LE(now, kClosed.stiffness * kPlay_rad) << "the servo pulls at " << angle;
    last = now;
  }
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

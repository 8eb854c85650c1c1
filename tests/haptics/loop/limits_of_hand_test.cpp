/// The limits of finger joints that follow from the contacts of the visible hand.

#include "loop/limits_of_hand.h"

#include <chrono>
#include <initializer_list>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/coupling.h>

#include "loop/fingers_of_hand.h"

namespace glissade::haptics {
namespace {

using devices::JointLimit;
using devices::JointLimits;
using std::chrono::milliseconds;

const FingerHand kBentFinger = [] {
  FingerHand range;
  range.lower[0] = range.lower[1] = -1.0;
  range.upper[0] = range.upper[1] = 1.0;
  return range;
}();

const devices::DeviceDescriptor kServoGlove = [] {
  devices::DeviceDescriptor glove = devices::simulated_glove_descriptor();  // 0.5 Nm a joint
  glove.finger_command = devices::FingerCommand::kJointLimit;
  glove.max_limit_stiffness = 5.0;
  return glove;
}();

/// Two joints that bend a finger towards a contact below it, with these arms (metres); the visible finger is bent by
/// 0.2 and 0.3 rad.
HandAnswer contact_below(double inner_arm, double outer_arm, double gap) {
  HandAnswer hand;
  hand.visible.angles[0] = 0.2;
  hand.visible.angles[1] = 0.3;
  hand.row_count = 1;
  hand.row_array[0].rates[0] = -inner_arm;
  hand.row_array[0].rates[1] = -outer_arm;
  hand.row_array[0].gap = gap;
  return hand;
}

JointLimits limits_at(const HandAnswer& answer, double share = 1.0) {
  return limits_of_hand(kBentFinger, kServoGlove, answer, share);
}

TEST(LimitsOfHand, AreTheVisibleJointsAtAContact) {
  const JointLimits limits = limits_at(contact_below(0.08, 0.03, 0.0));
  const double damping = 0.02 - 5.0 * 0.5e-3;  // what the stiffness leaves of the joint damping at half a period
  EXPECT_EQ(limits.joints[0], (JointLimit{.upper = 0.2, .stiffness = 5.0, .damping = damping, .max_torque = 0.5}));
  EXPECT_EQ(limits.joints[1], (JointLimit{.upper = 0.3, .stiffness = 5.0, .damping = damping, .max_torque = 0.5}));
  EXPECT_EQ(limits.joints[2], JointLimit{}) << "the contact does not concern this joint";
}

TEST(LimitsOfHand, AreForJointsWithAnActuatorOnly) {
  devices::DeviceDescriptor glove = kServoGlove;
  glove.undriven_joints.set(1);
  const JointLimits limits = limits_of_hand(kBentFinger, glove, contact_below(0.08, 0.03, 0.0), 1.0);
  EXPECT_EQ(limits.joints[0].upper, 0.2);
  EXPECT_EQ(limits.joints[1], JointLimit{});
}

TEST(LimitsOfHand, AreAheadOfAnApproachingFinger) {
  const JointLimits limits = limits_at(contact_below(0.08, 0.03, 4e-3));
  EXPECT_NEAR(limits.joints[0].upper, 0.2 + 4e-3 / 0.08, 1e-12);
  EXPECT_NEAR(limits.joints[1].upper, 0.3 + 4e-3 / 0.03, 1e-12);
}

TEST(LimitsOfHand, HoldOpeningFingersToo) {
  const JointLimits limits = limits_at(contact_below(-0.08, 0.03, 0.0));
  EXPECT_EQ(limits.joints[0].lower, 0.2);
  EXPECT_EQ(limits.joints[0].upper, devices::kNoLimit_rad);
}

TEST(LimitsOfHand, NearestContactCounts) {
  HandAnswer two = contact_below(0.08, 0.03, 4e-3);
  two.row_count = 2;
  two.row_array[1].rates[0] = -0.04;
  two.row_array[1].gap = 1e-3;
  EXPECT_NEAR(limits_at(two).joints[0].upper, 0.2 + 1e-3 / 0.04, 1e-12);
}

TEST(LimitsOfHand, ShortArmsGiveNone) {
  EXPECT_EQ(limits_at(contact_below(0.08, 1.9e-3, 0.0)).joints[1], JointLimit{});
}

TEST(LimitsOfHand, BeyondTheJointsRangeThereIsNothingToLimit) {
  EXPECT_EQ(limits_at(contact_below(0.01, 0.03, 9e-3)).joints[0], JointLimit{}) << "0.9 rad away";
}

TEST(LimitsOfHand, HaveTheirShareOfTheLargestTorque) {
  const HandAnswer touching = contact_below(0.08, 0.03, 0.0);
  EXPECT_EQ(limits_at(touching, 0.3).joints[0].max_torque, 0.3 * 0.5);
  EXPECT_FALSE(limits_at(touching, 0.0).any());
}

// So that a finger which went into the object in the meantime is not hit.
TEST(LimitsOfHand, FadeWithTheAgeOfTheAnswerAndReturnSoftly) {
  FingersOfHand fingers(kBentFinger, kServoGlove, kTickPeriod);
  const HandAnswer touching = contact_below(0.08, 0.03, 0.0);
  const auto torque_after = [&](milliseconds age) { return fingers.limits(touching, age, 1e-3).joints[0].max_torque; };
  EXPECT_EQ(torque_after(kFullForce), 0.5);
  EXPECT_NEAR(torque_after(milliseconds(60)), 0.25, 1e-12) << "halfway between 20 and 100 ms";
  EXPECT_EQ(torque_after(kForceless), 0.0);
  double last = 0.0;
  for (int ms = 1; ms <= 200; ++ms) {
    const double torque = torque_after(milliseconds(0));
    EXPECT_NEAR(torque, last + 0.5 / 200.0, 1e-12);
    last = torque;
  }
  EXPECT_NEAR(last, 0.5, 1e-9);
}

TEST(LimitsOfHand, AbsentJointsGetNone) {
  devices::DeviceDescriptor few = kServoGlove;
  few.joint_lower[0] = few.joint_upper[0] = 0.0;
  EXPECT_EQ(limits_of_hand(kBentFinger, few, contact_below(0.08, 0.03, 0.0), 1.0).joints[0], JointLimit{});
}

}  // namespace
}  // namespace glissade::haptics

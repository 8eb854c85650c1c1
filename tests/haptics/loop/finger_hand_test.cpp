/// A hand with fingers in the haptic kernel: it holds what the simulation decides, a part moves with its palm, and its
/// joints feel what stops them.

#include <algorithm>
#include <chrono>
#include <limits>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>

#include "allocation_counter.h"
#include "expect_bad_input.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using hands::JointValues;

constexpr std::size_t kWristJoint = 20;

/// Joints that reach from -1 to 1 rad, and a wrist 0.1 m before the tracker that turns about y.
FingerHand hand_with_wrist() {
  FingerHand hand;
  hand.lower.fill(-1.0);
  hand.upper.fill(1.0);
  hand.wrist = {{kWristJoint, Isometry3d(Eigen::Translation3d(0.1, 0.0, 0.0)), Vector3d::UnitY()}};
  return hand;
}

class FingerHandInKernel : public ::testing::Test {
 protected:
  FingerHandInKernel() {
    set_.sequence = 1;
    set_.part_count = 2;
    set_.parts[0].X_WV = set_.parts[0].X_WV_of_rows = Isometry3d(Eigen::Translation3d(0.2, 0.0, 0.0));
    set_.parts[1].X_WV = set_.parts[1].X_WV_of_rows = Isometry3d(Eigen::Translation3d(0.0, 0.5, 0.0));
  }

  /// The next millisecond, with `state_` and `set_` as new ones.
  const HandTick& tick() {
    now_ += kTickPeriod;
    state_.time = set_.time = now_;
    ++state_.sequence;
    const devices::GloveState* const newest = &state_;
    tick_ = kernel_.tick({&newest, 1}, set_, now_);
    return tick_.hands[0];
  }

  void decide(std::int32_t part) {
    set_.hands[0].part = part;
    ++set_.hands[0].decision;
  }

  /// The first joint bends towards something that stops it at angle 0.
  void touch_first_joint() {
    set_.hands[0].row_count = 1;
    set_.hands[0].row_array[0] = {};
    set_.hands[0].row_array[0].rates[0] = -0.03;
  }

  Vector3d ghost(std::size_t part) const { return tick_.ghosts.parts[part].X_WG.translation(); }

  devices::DeviceDescriptor device_ = devices::simulated_glove_descriptor();
  HapticKernel kernel_{{{Vector3d::Zero(), 0.05, {1000.0, 2.0}}, {Vector3d::Zero(), 0.05, {1000.0, 2.0}, true}},
                       {{.device = device_, .fingers = hand_with_wrist()}}};
  std::chrono::nanoseconds now_{0};
  devices::GloveState state_;
  ContactSet set_;
  HapticTick tick_;
};

TEST_F(FingerHandInKernel, HoldsWhatTheSimulationDecidesWhateverTheGripSays) {
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(tick().part, std::nullopt) << "closed from the start, near a part";
  decide(0);
  EXPECT_EQ(tick().part, 0u);
  EXPECT_EQ(tick_.ghosts.hands[0].part, 0);
  ++state_.grip;
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(tick().part, 0u) << "its grip has opened";
  decide(-1);
  EXPECT_EQ(tick().part, std::nullopt);
  EXPECT_EQ(tick_.ghosts.hands[0].part, -1);
}

TEST_F(FingerHandInKernel, TakesNothingThatMovesOnItsOwnOrDoesNotExist) {
  for (const std::int32_t part : {1, 2, 100}) {
    decide(part);
    EXPECT_EQ(tick().part, std::nullopt) << part;
  }
  EXPECT_FALSE(kernel_.grasp(0, 0)) << "only contacts decide";
}

TEST_F(FingerHandInKernel, MovesThePartWithThePalm) {
  tick();
  decide(0);
  tick();
  EXPECT_TRUE(ghost(0).isApprox(Vector3d(0.2, 0.0, 0.0))) << "nothing moves when it takes hold";
  state_.joint_angles[kWristJoint] = std::numbers::pi / 6.0;
  for (int i = 0; i < 100; ++i)
    tick();
  // 0.1 m beyond the wrist, which turns x towards −z.
  EXPECT_TRUE(ghost(0).isApprox(Vector3d(0.1 + 0.1 * std::sqrt(0.75), 0.0, -0.05), 1e-12)) << ghost(0).transpose();
}

TEST_F(FingerHandInKernel, DoesNotFollowAWristThatJumps) {
  tick();
  decide(0);
  tick();
  state_.joint_angles[kWristJoint] = 0.8;
  const Vector3d before = ghost(0);
  tick();
  EXPECT_LE((ghost(0) - before).norm(), 0.1 * 30.0 * 1e-3 + 1e-12);
}

TEST_F(FingerHandInKernel, GloveThatTakesLimitsGetsLimitsAndNoTorque) {
  device_.finger_command = devices::FingerCommand::kJointLimit;
  device_.max_limit_stiffness = 5.0;
  HapticKernel kernel{{{Vector3d::Zero(), 0.05, {1000.0, 2.0}}}, {{.device = device_, .fingers = hand_with_wrist()}}};
  touch_first_joint();
  state_.joint_angles[0] = 0.2;
  const devices::GloveState* const newest = &state_;
  devices::GloveCommand command;
  for (int i = 0; i < 1500; ++i) {
    now_ += kTickPeriod;
    state_.time = set_.time = now_;
    ++state_.sequence;
    command = kernel.tick({&newest, 1}, set_, now_).hands[0].command.values();
  }
  EXPECT_EQ(command.joint_torques, JointValues{});
  const devices::JointLimit& limit = command.joint_limits.joints[0];
  EXPECT_EQ(limit.upper, 0.0);
  EXPECT_NEAR(devices::limit_torque(limit, 0.2, 0.0), -0.5, 1e-9);
  EXPECT_EQ(command.joint_limits.joints[5], devices::JointLimit{});
}

TEST_F(FingerHandInKernel, TorqueOnlyAtTheStoppedJoint) {
  touch_first_joint();
  tick();
  EXPECT_EQ(tick().command.values().joint_torques, JointValues{});
  state_.joint_angles[0] = 0.2;
  state_.joint_angles[5] = 0.4;
  for (int i = 0; i < 400; ++i)
    tick();
  JointValues wanted{};
  wanted[0] = -device_.max_joint_torque;
  EXPECT_EQ(tick().command.values().joint_torques, wanted);
  set_.hands[0].row_count = 0;
  for (int i = 0; i < 8; ++i)
    tick();
  EXPECT_EQ(tick().command.values().joint_torques, JointValues{});
}

TEST_F(FingerHandInKernel, KeepsItsPartThroughANonFiniteContactSet) {
  touch_first_joint();
  decide(0);
  tick();
  set_.hands[0].row_array[0].rates[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(tick().part, 0u);
  for (const double torque : tick().command.values().joint_torques)
    EXPECT_TRUE(std::isfinite(torque));
}

// The simulation would take a gap for the loss of the hand, and begin its clasp anew.
TEST_F(FingerHandInKernel, KeepsItsLastAnglesFor100Milliseconds) {
  state_.joint_angles[3] = 0.25;
  tick();
  tick();
  EXPECT_TRUE(tick_.ghosts.hands[0].is_tracked);
  state_.joint_angles[3] = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 99; ++i)
    tick();
  EXPECT_TRUE(tick_.ghosts.hands[0].is_tracked);
  EXPECT_EQ(tick_.ghosts.hands[0].angles[3], 0.25);
  EXPECT_EQ(tick_.hands[0].command.values().joint_torques, JointValues{}) << "all the same";
  for (int i = 0; i < 3; ++i)
    tick();
  EXPECT_FALSE(tick_.ghosts.hands[0].is_tracked);
}

// On a busy machine: too late for a force, but the hand is there, and carries its part.
TEST_F(FingerHandInKernel, LateStatesStillMoveHandAndPart) {
  using std::chrono::milliseconds;
  tick();
  decide(0);
  tick();
  for (int i = 1; i <= 300; ++i) {
    now_ += kTickPeriod;
    state_.time = std::max<std::chrono::nanoseconds>(state_.time, now_ - milliseconds(15));
    state_.X_WH.translation().x() = 1e-4 * i;
    ++state_.sequence;
    const devices::GloveState* const newest = &state_;
    tick_ = kernel_.tick({&newest, 1}, set_, now_);
    ASSERT_TRUE(tick_.ghosts.hands[0].is_tracked) << i;
  }
  EXPECT_TRUE(tick_.hands[0].command.reasons().is_state_old);
  EXPECT_NEAR(tick_.ghosts.hands[0].X_WH.translation().x(), 0.03, 1e-12);
  EXPECT_NEAR(ghost(0).x(), 0.23, 1e-12);
}

TEST_F(FingerHandInKernel, IsLostATenthOfASecondAfterItsLastState) {
  tick();
  const devices::GloveState* const last = &state_;
  const auto silent = [&](int milliseconds) {
    for (int i = 0; i < milliseconds; ++i)
      tick_ = kernel_.tick({&last, 1}, set_, now_ += kTickPeriod);
    return !tick_.ghosts.hands[0].is_tracked;
  };
  EXPECT_FALSE(silent(98));
  EXPECT_TRUE(silent(4));
}

TEST_F(FingerHandInKernel, AllocatesNothing) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP();
  touch_first_joint();
  tick();
  const std::int64_t allocations = test_support::allocations_of_this_thread();
  decide(0);
  for (int i = 0; i < 100; ++i) {
    state_.joint_angles[0] += 0.001;
    state_.joint_angles[kWristJoint] += 0.001;
    tick();
  }
  EXPECT_EQ(test_support::allocations_of_this_thread(), allocations);
}

TEST(FingerHand, InitialPartIsRefused) {
  const KernelHand hand{devices::simulated_glove_descriptor(), 0, hand_with_wrist()};
  test_support::expect_bad_input(
      [&] {
        HapticKernel({{Vector3d::Zero(), 0.05, {1000.0, 2.0}}}, {hand});
      },
      {"hand 0", "fingers"});
}

TEST(FingerHand, NeedsAWristOfJointsThatTheGloveHas) {
  FingerHand fingers = hand_with_wrist();
  fingers.wrist[0].angle = hands::kJoints;
  const KernelHand hand{.device = devices::simulated_glove_descriptor(), .fingers = fingers};
  test_support::expect_bad_input([&] { HapticKernel({{Vector3d::Zero(), 0.05, {1000.0, 2.0}}}, {hand}); }, {"wrist"});
}

// A wall below the part, and a finger below it that holds it: the wall presses the part upwards, away from the finger,
// and onto another finger above.
TEST_F(FingerHandInKernel, AFingerFeelsTheLoadOfThePartThatItHolds) {
  decide(0);
  tick();
  set_.parts[0].hold = tick_.ghosts.parts[0].hold;
  set_.row_count = 1;
  set_.row_array[0] = {{{Vector3d::UnitZ(), Vector3d::Zero(), 0.0}}};  // it may not sink
  set_.row_array[0].pushes = true;
  set_.hands[0].row_count = 2;
  for (std::size_t joint = 0; joint < 2; ++joint) {
    FingerRow& row = set_.hands[0].row_array[joint];
    const double side = joint == 0 ? 1.0 : -1.0;
    row = {};
    row.rates[joint] = -0.05;
    row.part = 0;
    row.n_W = side * Vector3d::UnitZ();
    row.p_W = set_.parts[0].X_WV.translation() + side * 0.05 * Vector3d::UnitZ();
  }
  state_.X_WH.translation().z() -= 2e-3;
  for (int ms = 0; ms < 400; ++ms)
    tick();
  const devices::GloveCommand& pressed = tick_.hands[0].command.values();
  EXPECT_GT(pressed.f_H_W.z(), 0.8);
  EXPECT_NEAR(pressed.joint_torques[0], -0.05 * pressed.f_H_W.z(), 0.1 * 0.05 * pressed.f_H_W.z());
  EXPECT_EQ(pressed.joint_torques[1], 0.0);
  decide(-1);
  for (int ms = 0; ms < 200; ++ms)
    tick();
  EXPECT_EQ(tick_.hands[0].command.values().joint_torques, JointValues{}) << "it has let go";
}

}  // namespace
}  // namespace glissade::haptics

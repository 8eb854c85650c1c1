/// The half-spaces that follow from the contacts of the part in a hand.

#include <chrono>

#include <gtest/gtest.h>

#include "kernel_fixture.h"

namespace glissade::haptics {
namespace {

using devices::HalfSpaces;
using Eigen::Vector3d;
using std::chrono::milliseconds;

/// The hand starts 20 mm beside the part's reference point.
const Vector3d kHandAtStart(0.0, 0.02, 0.5);

/// A kernel for an arm that takes a wrench, beside one for the same arm that takes half-spaces.
class HalfSpacesOfHand : public Kernel {
 protected:
  static devices::GloveState hand_turned(const Vector3d& way, double angle, const Vector3d& axis) {
    devices::GloveState state;
    state.X_WH = Eigen::Translation3d(kHandAtStart + way) * Eigen::AngleAxisd(angle, axis);
    return state;
  }

  /// Both hands take hold of the part at the start, and then are at `state`.
  void settle_both(const devices::GloveState& state, const ContactSet& set) {
    tick(hand_at(kHandAtStart), set);
    hold_with_arm(hand_at(kHandAtStart), set, 1);
    wrench_ = settle(state, set);
    hold_with_arm(state, set, 500);
  }

  void hold_with_arm(devices::GloveState state, ContactSet set, int ticks, milliseconds age = milliseconds(0)) {
    for (int i = 0; i < ticks; ++i) {
      arm_now_ += kTickPeriod;
      state.time = arm_now_;
      state.sequence = ++arm_sequence_;
      set.time = arm_now_ - age;
      const devices::GloveState* const newest = &state;
      held_ = arm_.tick({&newest, 1}, set, arm_now_).hands[0];
    }
    arm_state_ = state;
  }

  const HalfSpaces& half_spaces() const { return held_.command.values().half_spaces; }

  HapticKernel arm_{{{part_.p_Vref(), part_.radius(), kKernelStiffness}}, {{holding(device_), 0}}};
  HandTick wrench_;
  HandTick held_;
  devices::GloveState arm_state_;
  std::chrono::nanoseconds arm_now_{0};
  std::int64_t arm_sequence_ = 0;

 private:
  static devices::DeviceDescriptor holding(devices::DeviceDescriptor device) {
    device.tool_command = devices::ToolCommand::kHalfSpaces;
    return device;
  }
};

/// The corners of a box on a floor below it, and a wall behind it.
ContactSet floor_and_wall(ContactSet set) {
  set.row_count = 0;
  for (const double x : {-0.05, 0.05}) {
    for (const double y : {-0.05, 0.05}) {
      ContactRow row{{{Vector3d::UnitZ(), Vector3d(x, y, -0.05), 0.0}}};
      row.pushes = true;
      set.row_array[static_cast<std::size_t>(set.row_count++)] = row;
    }
  }
  set.row_array[static_cast<std::size_t>(set.row_count++)] = {{{-Vector3d::UnitX(), Vector3d(0.05, 0.0, 0.04), -1e-3}}};
  return set;
}

TEST_F(HalfSpacesOfHand, ExertTheWrenchOfTheContacts) {
  const ContactSet set = floor_and_wall(floor_below(0.0));
  for (const double angle : {0.0, 0.01, 0.03}) {
    const devices::GloveState state = hand_turned(Vector3d(3e-3, 1e-3, -5e-3), angle, Vector3d::UnitY());
    settle_both(state, set);
    const devices::GloveCommand& wanted = wrench_.command.values();
    const devices::HandWrench held = devices::half_space_wrench(half_spaces(), arm_state_.X_WH);
    EXPECT_GT(wanted.f_H_W.norm(), 3.0);
    EXPECT_GT(wanted.t_H_W.norm(), 0.03);
    EXPECT_TRUE(held.f_H_W.isApprox(wanted.f_H_W, 1e-9)) << angle;
    EXPECT_TRUE(held.t_H_W.isApprox(wanted.t_H_W, 1e-9)) << angle;
    EXPECT_TRUE(held_.command.values().f_H_W.isZero(0.0)) << "and no wrench beside it";
  }
}

TEST_F(HalfSpacesOfHand, AreAheadOfAnApproachingHand) {
  const ContactSet set = floor_below(2e-3);
  hold_with_arm(hand_at(kHandAtStart), set, 300);
  ASSERT_EQ(half_spaces().count, 1U);
  const Eigen::Isometry3d above(Eigen::Translation3d(kHandAtStart - Vector3d(0.0, 0.0, 2e-3)));
  const Eigen::Isometry3d below(Eigen::Translation3d(kHandAtStart - Vector3d(0.0, 0.0, 3e-3)));
  EXPECT_TRUE(devices::half_space_wrench(half_spaces(), above).f_H_W.isZero(1e-9));
  EXPECT_NEAR(devices::half_space_wrench(half_spaces(), below).f_H_W.z(), 1e-3 * half_spaces().stiffness, 1e-9);
}

TEST_F(HalfSpacesOfHand, OfManyContactsAreThoseThatPushAndThoseNextToIt) {
  ContactSet set = floor_below(0.0);
  set.row_count = 40;
  for (std::size_t i = 0; i < 40; ++i)
    set.row_array[i] = {{{Vector3d::UnitZ(), Vector3d::Zero(), -1e-3 * static_cast<double>(40 - i)}}};
  hold_with_arm(hand_at(kHandAtStart), set, 1);
  hold_with_arm(hand_at(kHandAtStart - Vector3d(0.0, 0.0, 2e-3)), set, 300);
  ASSERT_EQ(half_spaces().count, devices::kMaxHalfSpaces);
  for (std::size_t i = 0; i < half_spaces().count; ++i)
    EXPECT_EQ(half_spaces().rows[i].bound, -1e-3 * static_cast<double>(i + 1));
}

TEST_F(HalfSpacesOfHand, AreAsStiffOverASlowLinkAsWithout) {
  devices::GloveState state = hand_at(kHandAtStart);
  state.link_delay = milliseconds(20);
  hold_with_arm(state, floor_below(2e-3), 500);
  EXPECT_GT(half_spaces().stiffness, 900.0) << "1000 N/m are wanted, 20 mm from the hand";
}

TEST_F(HalfSpacesOfHand, FadeWithTheAgeOfTheContacts) {
  const ContactSet set = floor_below(0.0);
  hold_with_arm(hand_at(kHandAtStart), set, 1);
  const devices::GloveState pressed = hand_at(kHandAtStart - Vector3d(0.0, 0.0, 5e-3));
  hold_with_arm(pressed, set, 500);
  const double fresh = devices::half_space_wrench(half_spaces(), pressed.X_WH).f_H_W.z();
  EXPECT_GT(fresh, 4.0);
  hold_with_arm(pressed, set, 100, milliseconds(60));
  const double old = devices::half_space_wrench(half_spaces(), pressed.X_WH).f_H_W.z();
  EXPECT_NEAR(old, 0.5 * fresh, 1e-6) << "halfway between 20 and 100 ms";
  hold_with_arm(pressed, set, 100, milliseconds(100));
  EXPECT_FALSE(half_spaces().any());
}

TEST_F(HalfSpacesOfHand, ThatHoldsNoPartAreNone) {
  hold_with_arm(hand_at(kHandAtStart), floor_below(1e-3), 300);
  EXPECT_TRUE(half_spaces().any());
  arm_.release(0);
  hold_with_arm(hand_at(kHandAtStart), floor_below(1e-3), 10);
  EXPECT_FALSE(half_spaces().any());
}

}  // namespace
}  // namespace glissade::haptics

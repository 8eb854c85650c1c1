/// What the load of a held part does to the fingers that hold it.

#include "loop/finger_load.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <glissade/contact/spring.h>
#include <glissade/devices/simulated_glove.h>

#include "random_numbers.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;
using hands::JointValues;

constexpr std::int32_t kHeld = 2;
constexpr double kPartRadius_m = 0.03;
constexpr double kArm_m = 0.06;
constexpr double kFingerTick_s = 1e-3;
enum Joint : std::size_t { kThumb, kIndex, kWrist };
constexpr std::array<std::size_t, 1> kMovesPart{kWrist};

/// A part of 60 mm at the origin between the thumb, on the side of −x, and the index, on that of +x. Each has one
/// joint, whose angle grows as it closes.
HandAnswer pinch() {
  HandAnswer hand;
  hand.row_count = 2;
  for (const auto& [joint, side] : {std::pair{kThumb, -1.0}, std::pair{kIndex, 1.0}}) {
    FingerRow& row = hand.row_array[joint];
    row.rates[joint] = -kArm_m;
    row.part = kHeld;
    row.n_W = side * Vector3d::UnitX();
    row.p_W = side * kPartRadius_m * Vector3d::UnitX();
  }
  return hand;
}

class LoadOnFingers : public ::testing::Test {
 protected:
  const JointValues& tick(const HandAnswer& hand, const Vector3d& f_W, std::int32_t part = kHeld) {
    const FingerLoad::Load load{part, {f_W, Vector3d::Zero()}, Vector3d::Zero(), kPartRadius_m};
    return load_.update(hand, load, springs_, angles_, kFingerTick_s);
  }
  JointValues settle(const HandAnswer& hand, const Vector3d& f_W, std::int32_t part = kHeld) {
    for (int ms = 0; ms < 31; ++ms)
      tick(hand, f_W, part);
    return tick(hand, f_W, part);
  }

  devices::DeviceDescriptor device_ = devices::simulated_glove_descriptor();
  FingerLoad load_{device_, kMovesPart};
  JointValues springs_{};
  JointValues angles_{};
};

TEST_F(LoadOnFingers, IsFeltByTheFingerOnTheSideToWhichThePartIsPressed) {
  const JointValues torques = settle(pinch(), {3.0, 0.0, 0.0});
  EXPECT_NEAR(torques[kIndex], -3.0 * kArm_m, 0.1 * 3.0 * kArm_m) << "opens the index";
  EXPECT_EQ(torques[kThumb], 0.0) << "nothing pulls at the thumb";
}

// It would move the part against the load, and fight with the force on the arm.
TEST_F(LoadOnFingers, IsNotFeltByTheWrist) {
  HandAnswer hand = pinch();
  hand.row_array[kIndex].rates[kWrist] = -0.15;
  EXPECT_EQ(settle(hand, {3.0, 0.0, 0.0})[kWrist], 0.0);
}

TEST_F(LoadOnFingers, IsNotFeltWhereNoContactCanCarryIt) {
  for (const double torque : settle(pinch(), {0.0, 3.0, 0.0}))
    EXPECT_NEAR(torque, 0.0, 1e-12);
}

TEST_F(LoadOnFingers, OfACoupleIsSharedByBothFingers) {
  HandAnswer hand = pinch();
  hand.row_array[kThumb].n_W = -Vector3d::UnitY();  // both press along y, 60 mm apart
  hand.row_array[kIndex].n_W = Vector3d::UnitY();
  const contact::Wrench couple{Vector3d::Zero(), 0.12 * Vector3d::UnitZ()};  // 2 N at each
  JointValues torques{};
  for (int ms = 0; ms < 32; ++ms)
    torques = load_.update(hand, {kHeld, couple, Vector3d::Zero(), kPartRadius_m}, springs_, angles_, kFingerTick_s);
  EXPECT_NEAR(torques[kThumb], -2.0 * kArm_m, 0.1 * 2.0 * kArm_m);
  EXPECT_NEAR(torques[kIndex], -2.0 * kArm_m, 0.1 * 2.0 * kArm_m);
}

TEST_F(LoadOnFingers, ComesAndGoesWithinThirtyMilliseconds) {
  const double step = device_.max_joint_torque / 30.0;
  double last = 0.0;
  for (int ms = 0; ms < 80; ++ms) {
    const double torque = tick(pinch(), {ms < 40 ? 100.0 : 0.0, 0.0, 0.0})[kIndex];
    EXPECT_LE(std::abs(torque - last), step + 1e-12);
    EXPECT_LE(std::abs(torque), device_.max_joint_torque);
    if (ms == 39) {
      EXPECT_EQ(torque, -0.5 * device_.max_joint_torque);
    }
    last = torque;
  }
  EXPECT_EQ(last, 0.0);
}

// A finger that the load takes off the part would feel no load there, and come back: it would shake.
TEST_F(LoadOnFingers, FadesWhereTheGloveLeavesThePart) {
  const double full = settle(pinch(), {3.0, 0.0, 0.0})[kIndex];
  angles_[kIndex] = -0.1e-3 / kArm_m;
  EXPECT_EQ(settle(pinch(), {3.0, 0.0, 0.0})[kIndex], full) << "0.1 mm off";
  angles_[kIndex] = -0.7e-3 / kArm_m;
  EXPECT_NEAR(settle(pinch(), {3.0, 0.0, 0.0})[kIndex], 0.5 * full, 1e-9) << "0.7 mm off";
  angles_[kIndex] = -1.3e-3 / kArm_m;
  EXPECT_EQ(settle(pinch(), {3.0, 0.0, 0.0})[kIndex], 0.0) << "1.3 mm off";
}

TEST_F(LoadOnFingers, IsExactlyZeroWhereNothingIsHeldOrTouched) {
  EXPECT_EQ(settle(pinch(), Vector3d::UnitX(), -1), JointValues{}) << "holds nothing";
  EXPECT_EQ(settle(pinch(), Vector3d::UnitX(), kHeld + 1), JointValues{}) << "holds another part";
  EXPECT_EQ(settle(HandAnswer{}, Vector3d::UnitX()), JointValues{}) << "touches nothing";
  EXPECT_EQ(settle(pinch(), Vector3d::Zero()), JointValues{}) << "no load";
}

// A hand that opens under the load and closes without it would take energy out of the glove, again and again.
TEST_F(LoadOnFingers, GivesNoMoreEnergyThanItIsAllowed) {
  double given_J = 0.0;
  for (int ms = 0; ms < 20'000; ++ms) {
    const bool is_opening = ms / 50 % 2 == 0;
    const JointValues torques = tick(pinch(), {is_opening ? 3.0 : 0.0, 0.0, 0.0});
    const double moved = is_opening ? -2e-4 : 2e-4;
    given_J += torques[kIndex] * moved;
    angles_[kIndex] += moved;
    ASSERT_LE(given_J, 20e-3 + 5e-3 * kFingerTick_s * ms + 2e-4 * device_.max_joint_torque) << ms << " ms";
  }
  EXPECT_GT(given_J, 20e-3) << "it has been tried";
}

TEST_F(LoadOnFingers, NoRandomHandGetsMoreEnergyThanIsAllowed) {
  constexpr std::uint64_t kSeed = 12;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  test_support::RandomNumbers random(kSeed);
  double given_J = 0.0;
  HandAnswer hand = pinch();
  for (int ms = 0; ms < 50'000; ++ms) {
    if (ms % 50 == 0) hand.row_array[kThumb].n_W = random.direction();
    const JointValues torques = tick(hand, random.uniform(0.0, 10.0) * random.direction());
    for (const Joint joint : {kThumb, kIndex}) {
      const double moved = random.uniform(-3e-3, 3e-3) - 1e-3 * std::sin(1e-3 * ms);
      given_J += torques[joint] * moved;
      angles_[joint] += moved;
      hand.visible.angles[joint] = angles_[joint];
    }
    ASSERT_LE(given_J, 20e-3 + 5e-3 * kFingerTick_s * ms + 8e-3 * device_.max_joint_torque) << ms << " ms";
  }
}

// Where it fades, it is a spring over a millimetre, which must be as soft as the finger's own spring.
TEST_F(LoadOnFingers, IsLessBehindALink) {
  load_.set_link(20e-3, 1.0);
  EXPECT_NEAR(settle(pinch(), {3.0, 0.0, 0.0})[kIndex], -1.0 * 1e-3 / kArm_m, 1e-9);
}

TEST_F(LoadOnFingers, OfSeveralJointsIsNoStifferThanThatOfOne) {
  constexpr double kStiffness = 4.0;  // Nm/rad
  load_.set_link(5e-3, kStiffness);
  HandAnswer hand = pinch();
  hand.row_array[kIndex].rates = {};
  const std::array<std::size_t, 3> joints{4, 5, 6};
  const std::array<double, 3> arms{0.09, 0.05, 0.025};
  double squares = 0.0;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    hand.row_array[kIndex].rates[joints[i]] = -arms[i];
    squares += arms[i] * arms[i];
  }
  const JointValues torques = settle(hand, {20.0, 0.0, 0.0});
  for (std::size_t i = 0; i < joints.size(); ++i)
    EXPECT_NEAR(torques[joints[i]], -kStiffness * 1e-3 * arms[i] / squares, 1e-9) << "joint " << joints[i];
}

/// A glove that measures every 10 ms: the account sees the same motion.
TEST_F(LoadOnFingers, OfASlowGloveGivesNoMoreEnergyThanItIsAllowed) {
  double given_J = 0.0;
  double angle = 0.0;
  for (int ms = 0; ms < 20'000; ++ms) {
    const bool is_opening = ms / 50 % 2 == 0;
    if (ms % 10 == 0) angles_[kIndex] = angle;
    const double torque = tick(pinch(), {is_opening ? 3.0 : 0.0, 0.0, 0.0})[kIndex];
    const double moved = is_opening ? -3e-4 : 3e-4;
    given_J += torque * moved;
    angle += moved;
    ASSERT_LE(given_J, 20e-3 + 5e-3 * kFingerTick_s * ms + 3e-3 * device_.max_joint_torque) << ms << " ms";
  }
  EXPECT_GT(given_J, 10e-3) << "it has been tried";
}

/// Torques that act 10 ms late on a finger that goes to and fro, loaded on the way out only when it is seen.
TEST_F(LoadOnFingers, BehindALinkGivesNoMoreEnergyThanItIsAllowed) {
  constexpr std::size_t kDelay = 10;
  load_.set_link(1e-3 * kDelay, 30.0);
  std::deque<double> under_way(kDelay, 0.0);
  double given_J = 0.0;
  for (int ms = 0; ms < 20'000; ++ms) {
    const bool will_open = (ms + static_cast<int>(kDelay)) / 50 % 2 == 0;
    under_way.push_back(tick(pinch(), {will_open ? 3.0 : 0.0, 0.0, 0.0})[kIndex]);
    const double moved = ms / 50 % 2 == 0 ? -2e-4 : 2e-4;
    given_J += under_way.front() * moved;
    under_way.pop_front();
    angles_[kIndex] += moved;
    ASSERT_LE(given_J, 20e-3 + 5e-3 * kFingerTick_s * ms + 2e-3 * device_.max_joint_torque) << ms << " ms";
  }
  EXPECT_GT(given_J, 20e-3) << "it has been tried";
}

TEST_F(LoadOnFingers, SumWithSpringsStaysWithinTheDeviceLimit) {
  springs_[kIndex] = -0.45;
  EXPECT_NEAR(settle(pinch(), {100.0, 0.0, 0.0})[kIndex], -0.05, 1e-12);
}

TEST_F(LoadOnFingers, IsThereAgainSoonAfterAnAngleThatWasWrong) {
  const double full = settle(pinch(), {3.0, 0.0, 0.0})[kIndex];
  angles_[kIndex] = -6.0;
  tick(pinch(), {3.0, 0.0, 0.0});
  angles_[kIndex] = 0.0;
  for (int ms = 0; ms < 2000; ++ms)
    tick(pinch(), {3.0, 0.0, 0.0});
  EXPECT_NEAR(settle(pinch(), {3.0, 0.0, 0.0})[kIndex], full, 1e-9);
}

TEST_F(LoadOnFingers, StaysFiniteForNaNAngles) {
  settle(pinch(), Vector3d::UnitX());
  angles_[kIndex] = std::numeric_limits<double>::quiet_NaN();
  for (const double torque : tick(pinch(), Vector3d::UnitX()))
    EXPECT_TRUE(std::isfinite(torque));
  EXPECT_TRUE(std::isfinite(load_.energy()));
}

}  // namespace
}  // namespace glissade::haptics

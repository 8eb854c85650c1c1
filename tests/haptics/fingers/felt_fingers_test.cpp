/// The whole loop of a wearer whose fingers close round a ball: where they stop, and that nothing shakes or jumps.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "poses.h"
#include "worn_glove.h"

namespace glissade::haptics {
namespace {

using grasping::Posture;
using hands::JointValues;
using hands::kJoints;
using std::chrono::milliseconds;
using test_support::at;
using test_support::bent_hand;
using test_support::hand_chain;
using test_support::WornGlove;

constexpr double kOneDegree = std::numbers::pi / 180.0;

/// Closes after 100 ms round a ball before the palm, and opens after three seconds.
WornGlove glove_at_ball(const Posture& fist = bent_hand(0.9),
                        std::vector<std::chrono::nanoseconds> grips = {milliseconds(100), milliseconds(3000)}) {
  return {geometry::make_sphere(0.035, 2000), at(0.095, 0.0, -0.056),
          geometry::PoseTrajectory({{milliseconds(0), Eigen::Isometry3d::Identity()}}), fist, std::move(grips)};
}

/// The angle at which a joint is stopped if all others are as in the visible hand: by halving, with the independent
/// check. At most 2 degrees away from the visible hand's.
double geometric_stop(const WornGlove& glove, std::size_t joint, double direction) {
  const Posture visible = glove.hand.clasp.posture();
  double free = 0.0;
  double colliding = 2.0 * kOneDegree;
  while (colliding - free > 1e-4 * kOneDegree) {
    const double middle = 0.5 * (free + colliding);
    Posture nearer = visible;
    nearer.values[joint] += std::copysign(middle, direction);
    (glove.hand.collides(nearer) ? colliding : free) = middle;
  }
  return visible.values[joint] + std::copysign(free, direction);
}

// The muscles of the wearer are springs: a joint that is stopped at q presses with finger_stiffness · (fist − q), here
// at most 0.45 of the device's 0.5 Nm.
TEST(FeltFingers, StopWithinADegreeOfTheSurface) {
  WornGlove glove = glove_at_ball();
  glove.run(2500);
  const JointValues& torques = glove.command().values().joint_torques;
  const JointValues angles = glove.state().joint_angles;
  int stopped = 0;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const double will = bent_hand(0.9).values[joint] - angles[joint];
    if (torques[joint] == 0.0) {
      EXPECT_NEAR(will, 0.0, 0.01 * kOneDegree)
          << hand_chain()->values()[joint].name << " is not where the wearer wants";
      continue;
    }
    EXPECT_NEAR(torques[joint], -devices::SimulatedGloveParameters{}.finger_stiffness * will, 1e-6);
    EXPECT_NEAR(angles[joint], geometric_stop(glove, joint, will), 1.0 * kOneDegree)
        << hand_chain()->values()[joint].name;
    ++stopped;
  }
  EXPECT_GE(stopped, 5);
}

TEST(FeltFingers, AreAtRestAndFeelASteadyTorque) {
  WornGlove glove = glove_at_ball();
  glove.run(2000);
  const JointValues angles = glove.state().joint_angles;
  const JointValues torques = glove.command().values().joint_torques;
  for (int i = 0; i < 500; ++i) {
    glove.step();
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      ASSERT_NEAR(glove.state().joint_angles[joint], angles[joint], 0.01 * kOneDegree) << "after " << i << " ms";
      ASSERT_NEAR(glove.command().values().joint_torques[joint], torques[joint], 1e-3) << "after " << i << " ms";
    }
  }
}

// The glove with its friction is passive, however often the wearer closes and opens his hand; and a hand at rest moves
// no energy, so nothing oscillates.
TEST(FeltFingers, GetBackNoMoreEnergyThanTheyPutIn) {
  std::vector<std::chrono::nanoseconds> grips;
  for (int i = 1; i <= 20; ++i)
    grips.emplace_back(milliseconds(10 * i * i % 170 + 150 * i));
  WornGlove glove = glove_at_ball(bent_hand(0.9), grips);
  for (int i = 0; i < 3500; ++i) {
    glove.step();
    ASSERT_GE(glove.energy(), 0.0) << "after " << i << " ms";
  }
  EXPECT_GT(glove.energy(), 1e-3);
  const double at_rest = glove.energy();
  glove.run(500);
  EXPECT_NEAR(glove.energy(), at_rest, 1e-6);
}

TEST(FeltFingers, FeelExactlyNothingBeforeAndAfterTheContact) {
  WornGlove glove = glove_at_ball();
  glove.run(100);
  EXPECT_EQ(glove.command().values().joint_torques, JointValues{});
  glove.run(2000);
  EXPECT_NE(glove.command().values().joint_torques, JointValues{});
  glove.run(1400);
  EXPECT_EQ(glove.command().values().joint_torques, JointValues{});
}

TEST(FeltFingers, FeelTorquesThatChangeNoFasterThanTheDeviceAllows) {
  WornGlove glove = glove_at_ball();
  const devices::DeviceDescriptor& device = glove.descriptor();
  const double step = device.max_joint_torque / 2.0;  // from zero to the maximum in two periods
  JointValues last{};
  for (int i = 0; i < 3500; ++i) {
    glove.step();
    const JointValues& torques = glove.command().values().joint_torques;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      ASSERT_LE(std::abs(torques[joint]), device.max_joint_torque) << i;
      ASSERT_LE(std::abs(torques[joint] - last[joint]), step * (1.0 + 1e-9)) << i;
    }
    last = torques;
  }
}

// A wearer who is stronger than the glove goes on into the ball, against the largest torque; the visible hand does not.
TEST(FeltFingers, TorquesSaturateForAStrongWearer) {
  Posture fist = bent_hand(0.9);
  for (double& value : fist.values)
    value *= 3.0;
  WornGlove glove = glove_at_ball(fist);
  glove.run(2500);
  const JointValues& torques = glove.command().values().joint_torques;
  EXPECT_GE(std::count(torques.begin(), torques.end(), -glove.descriptor().max_joint_torque), 5);
  EXPECT_FALSE(glove.hand.collides(glove.hand.clasp.posture()));
}

}  // namespace
}  // namespace glissade::haptics

/// How a loose part yields to hands.

#include "life/push.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

namespace glissade::grasping {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A ball of 35 mm at the origin that segments press on.
class PushedBall : public ::testing::Test {
 protected:
  /// A segment presses at the ball from this direction.
  void press(const Vector3d& from_W, double depth) {
    LinkContact touch{};
    touch.contact.n_W = from_W.normalized();
    touch.contact.p_W = ball_.radius() * touch.contact.n_W;
    touch.depth = depth;
    push_.add(touch, speed_m_per_ms, Vector3d::Zero());
  }
  geometry::Displacement displacement(double milliseconds = 1.0) {
    return push_.displacement(ball_.radius(), milliseconds);
  }

  double speed_m_per_ms = 1.0;

 private:
  contact::SlidingPart ball_{std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.035, 500))};
  Push push_;
};

TEST_F(PushedBall, MovesWithTheSegmentLessTheResistance) {
  press(Vector3d::UnitX(), GraspingHand::kResistance_m + 2e-3);
  EXPECT_LT(displacement().v.x(), -1.5e-3);
  EXPECT_GE(displacement().v.x(), -2e-3);
  EXPECT_LT(displacement().v.tail<2>().norm(), 1e-9);
}

TEST_F(PushedBall, StaysWhereASegmentHardlyPressesIt) {
  press(Vector3d::UnitX(), 0.9 * GraspingHand::kResistance_m);
  EXPECT_TRUE(displacement().is_zero());
}

TEST_F(PushedBall, StaysBetweenSegmentsThatPressFromBothSides) {
  press(Vector3d::UnitX(), GraspingHand::kResistance_m + 2e-3);
  press(-Vector3d::UnitX(), GraspingHand::kResistance_m + 2e-3);
  EXPECT_LT(displacement().v.norm(), 0.1e-3);
}

// Only far to the side would there be room for both.
TEST_F(PushedBall, JumpsNoFartherThanTheSegmentsWantToGo) {
  constexpr double kNearlyOpposed = 170.0 * std::numbers::pi / 180.0;
  press(Vector3d::UnitX(), GraspingHand::kResistance_m + 10e-3);
  press({std::cos(kNearlyOpposed), std::sin(kNearlyOpposed), 0.0}, GraspingHand::kResistance_m + 10e-3);
  EXPECT_LE(geometry::motion_bound(displacement(), 0.035), 10e-3 + 1e-9);
}

// The target of a finger that was blocked lies far beyond the ball.
TEST_F(PushedBall, GoesLittleFasterThanTheSegment) {
  speed_m_per_ms = 0.5e-3;
  press(Vector3d::UnitX(), GraspingHand::kResistance_m + 30e-3);
  EXPECT_NEAR(displacement().v.x(), -Push::kFastest * speed_m_per_ms, 1e-6);
}

// The thumb would push a part away before the fingers, which are as late, can close round it.
TEST_F(PushedBall, GoesNoFartherInALateCallThanInFiveMilliseconds) {
  speed_m_per_ms = 0.2e-3;
  press(Vector3d::UnitX(), GraspingHand::kResistance_m + 30e-3);
  EXPECT_NEAR(displacement(60.0).v.x(), -Push::kFastest * speed_m_per_ms * 5.0, 1e-6);
}

TEST_F(PushedBall, SegmentMotionOfALateCallDoesNotPushYet) {
  speed_m_per_ms = 0.3e-3;
  press(Vector3d::UnitX(), GraspingHand::kResistance_m + 1e-3);
  EXPECT_LT(displacement(1.0).v.x(), -0.4e-3);
  EXPECT_TRUE(displacement(5.0).is_zero()) << "1.2 mm of its way are of this call";
}

TEST_F(PushedBall, StaysWhileTheSegmentStandsStill) {
  speed_m_per_ms = 0.0;
  press(Vector3d::UnitX(), GraspingHand::kResistance_m + 30e-3);
  EXPECT_TRUE(displacement().is_zero());
}

}  // namespace
}  // namespace glissade::grasping

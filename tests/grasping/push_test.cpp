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

constexpr std::int32_t kBody = 3;

/// A ball of 35 mm at the origin that segments press on.
class PushedBall : public ::testing::Test {
 protected:
  /// A segment presses at the ball from this direction.
  void press(const Vector3d& from_W, double depth) {
    LinkContact touch{};
    touch.contact.n_W = from_W.normalized();
    touch.contact.p_W = ball_.radius() * touch.contact.n_W;
    touch.contact.obstacle = kBody;
    touch.depth = depth;
    push_.add({touch}, kBody, Isometry3d::Identity(), ball_);
  }
  geometry::Displacement displacement() { return push_.displacement(ball_.radius()); }

 private:
  haptics::SlidingPart ball_{std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.035, 500))};
  Push push_;
};

TEST_F(PushedBall, GoesWhereOneSegmentPressesItAndResistsALittle) {
  press(Vector3d::UnitX(), Push::kPress_m + 2e-3);
  EXPECT_LT(displacement().v.x(), -1.5e-3);
  EXPECT_GE(displacement().v.x(), -2e-3);
  EXPECT_LT(displacement().v.tail<2>().norm(), 1e-9);
}

TEST_F(PushedBall, StaysWhereASegmentHardlyPressesIt) {
  press(Vector3d::UnitX(), 0.9 * Push::kPress_m);
  EXPECT_TRUE(displacement().is_zero());
}

TEST_F(PushedBall, StaysBetweenSegmentsThatPressFromBothSides) {
  press(Vector3d::UnitX(), Push::kPress_m + 2e-3);
  press(-Vector3d::UnitX(), Push::kPress_m + 2e-3);
  EXPECT_LT(displacement().v.norm(), 0.1e-3);
}

// Only far to the side would there be room for both.
TEST_F(PushedBall, JumpsNoFartherThanTheSegmentsWantToGo) {
  constexpr double kNearlyOpposed = 170.0 * std::numbers::pi / 180.0;
  press(Vector3d::UnitX(), 10e-3);
  press({std::cos(kNearlyOpposed), std::sin(kNearlyOpposed), 0.0}, 10e-3);
  EXPECT_LE(geometry::motion_bound(displacement(), 0.035), 10e-3 + 1e-9);
}

}  // namespace
}  // namespace glissade::grasping

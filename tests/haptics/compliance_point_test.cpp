// The point of a part at which the hand acts.

#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/sliding.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;

/// A rod of 0.2 m along z; its lower end is at z = -0.1 in its frame.
std::shared_ptr<const geometry::TriangleMesh> rod() {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.02, 0.02, 0.2}, 12));
}

/// The turn (radians) of a rod that stands beside a low wall, after the hand has pushed it 5 mm into the wall's top.
double turn_at_the_wall(const std::shared_ptr<const SlidingPart>& part_V) {
  // The wall's face is at x = 0.05, its top at the height of the rod's lower end.
  const Obstacle wall = test_support::obstacle_of(geometry::make_box({0.1, 0.4, 0.02}, 12), at(0.1, 0.0, -0.1));
  Sliding sliding({wall}, part_V, at(0.03), {.metaphor = Metaphor::kForceFeedback});
  test_support::lead(sliding, at(0.045), 100);
  EXPECT_GE(test_support::hold_until_rest(sliding), 0);
  EXPECT_GT(sliding.result().pushing, 0);
  return Eigen::AngleAxisd(sliding.result().X_WV.linear()).angle();
}

TEST(CompliancePoint, APushAtTheTipDoesNotTurnThePart) {
  EXPECT_LT(turn_at_the_wall(std::make_shared<SlidingPart>(rod(), Vector3d(0.0, 0.0, -0.1))), 1e-3);
  EXPECT_GT(turn_at_the_wall(std::make_shared<SlidingPart>(rod())), 1e-2) << "a push at the middle tips it";
}

TEST(CompliancePoint, TheRadiusIsTheDistanceOfTheFarthestVertex) {
  const SlidingPart part(rod(), {0.0, 0.0, -0.1});
  EXPECT_NEAR(part.radius(), Vector3d(0.01, 0.01, 0.2).norm(), 1e-15);
  EXPECT_EQ(part.p_Vref(), Vector3d(0.0, 0.0, -0.1));
  EXPECT_EQ(SlidingPart(rod()).p_Vref(), Vector3d(0.0, 0.0, 0.0));
}

TEST(CompliancePoint, MustLieNearThePart) {
  EXPECT_THROW(SlidingPart(rod(), {0.0, 0.0, 1.1}), std::invalid_argument);
  EXPECT_THROW(SlidingPart(rod(), {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::haptics

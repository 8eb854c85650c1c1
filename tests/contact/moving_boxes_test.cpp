// The check of paths that the tests with several processes rely on: it must see what goes through, and prove what does
// not.

#include "moving_boxes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "poses.h"
#include "random_numbers.h"
#include "swept_check.h"

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const Vector3d kCube(0.02, 0.02, 0.02);

MovingBox still(const Vector3d& half, const Isometry3d& X_WB = Isometry3d::Identity()) {
  return {half, X_WB, X_WB};
}

TEST(MovingBoxes, SeeABoxGoThroughASheetThoughNeitherEndMeetsIt) {
  const MovingBox sheet = still({0.2, 0.2, 0.0});
  EXPECT_FALSE(stay_apart(sheet, {kCube, at(0.0, 0.0, 0.021), at(0.0, 0.0, -0.021)}));
  EXPECT_TRUE(stay_apart(sheet, {kCube, at(0.0, 0.0, 0.021), at(0.1, 0.0, 0.020001)}));
  EXPECT_TRUE(stay_apart(sheet, {kCube, at(0.0, 0.0, 0.021), at(0.0, 0.0, 1.0)}));
}

TEST(MovingBoxes, DetectsACollisionInMidRotation) {
  const Vector3d rod(0.1, 1e-3, 1e-3);
  const Isometry3d quarter = pose(Vector3d::Zero(), turn(0.5 * std::numbers::pi, Vector3d::UnitZ()));
  const double tip = std::hypot(0.1, 1e-3);  // how far its corners reach
  for (const double gap : {1e-6, -1e-6}) {
    const double reach = (tip + gap + 0.01) / std::sqrt(2.0);
    const MovingBox post =
        still({0.01, 0.01, 0.01}, pose({reach, reach, 0.0}, turn(0.25 * std::numbers::pi, Vector3d::UnitZ())));
    EXPECT_EQ(stay_apart(post, {rod, Isometry3d::Identity(), quarter}), gap > 0.0);
  }
}

TEST(MovingBoxes, CertifiesANanometreGapUnderCommonMotion) {
  const Isometry3d X_aside = pose({0.3, -0.1, 0.2}, turn(0.4, {1.0, 2.0, 0.0}));
  const MovingBox left{kCube, at(-0.02), X_aside * at(-0.02)};
  EXPECT_TRUE(stay_apart(left, {kCube, at(0.02 + 1e-9), X_aside * at(0.04)}));
  EXPECT_FALSE(stay_apart(left, {kCube, at(0.02 + 1e-9), X_aside * at(-0.06)})) << "it goes through the other";
}

/// Against the triangles of the same boxes, one of which stands still.
TEST(MovingBoxes, AgreeWithTheSweptCheckOfTriangles) {
  constexpr std::uint64_t kSeed = 5;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", pair " + std::to_string(i));
    const Vector3d half_a(random.uniform(0.005, 0.05), random.uniform(0.005, 0.05), random.uniform(0.005, 0.05));
    const Vector3d half_b(random.uniform(0.005, 0.05), random.uniform(0.005, 0.05), random.uniform(0.005, 0.05));
    const auto place = [&] {
      return pose(0.08 * random.direction(), turn(random.uniform(-1.0, 1.0), random.direction()));
    };
    const MovingBox moving{half_b, place(), place()};
    if (!separating_axis(half_a, Isometry3d::Identity(), half_b, moving.X_WB_from)) continue;
    SweptCheck check({obstacle_of(geometry::make_box(2.0 * half_a, 12))}, geometry::make_box(2.0 * half_b, 12),
                     Vector3d::Zero());
    const bool is_free = !check.fault_of(
        moving.X_WB_from, geometry::displacement_between(moving.X_WB_from, moving.X_WB_to, Vector3d::Zero()));
    EXPECT_EQ(stay_apart(still(half_a), moving), is_free);
    apart += is_free ? 1 : 0;
  }
  EXPECT_GT(apart, 20);
  EXPECT_LT(apart, 280);
}

}  // namespace
}  // namespace glissade::test_support

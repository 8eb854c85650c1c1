// Ways out of an overlap, against depths known in closed form. That a way out leads out is checked by brute force.

#include <cmath>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/reference/brute_force.h>

#include "poses.h"
#include "random_numbers.h"
#include "trees.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;
using test_support::tree_of;

constexpr std::uint64_t kPenetrationSeed = 20261122;

// The depth, having checked that the way leads out.
double depth_of(const DopTree& A, const DopTree& B, const Isometry3d& X_AB, double clearance = 0.0) {
  QueryWorkspace workspace;
  const Penetration penetration = find_way_out(A, B, X_AB, workspace, clearance);
  Isometry3d X_out = X_AB;
  X_out.translation() += penetration.way_out_A;
  EXPECT_FALSE(reference::brute_force_intersects(A.mesh(), B.mesh(), X_out));
  EXPECT_FALSE(intersects(A, B, X_out, workspace, clearance));
  return penetration.depth();
}

TEST(WayOut, IsNoneForMeshesThatAreApart) {
  const DopTree box = tree_of(geometry::make_box({1.0, 1.0, 1.0}, 48));
  EXPECT_EQ(depth_of(box, box, at(1.1)), 0.0);
  EXPECT_NEAR(depth_of(box, box, at(1.1), 0.3), 0.2, 2e-3) << "but not by that clearance";
}

TEST(WayOut, NearlyZeroForTouchingMeshes) {
  const DopTree box = tree_of(geometry::make_box({1.0, 1.0, 1.0}, 48));
  EXPECT_LE(depth_of(box, box, at(1.0)), 1e-9);
  const auto corner = [](double size) {
    return tree_of({{Vector3d::Zero(), size * Vector3d::UnitX(), size * Vector3d::UnitY(), size * Vector3d::UnitZ()},
                    {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}});
  };
  EXPECT_LE(depth_of(corner(60.0), corner(0.06), Isometry3d::Identity()), 0.06) << "three of its faces lie in those";
}

TEST(WayOut, OfABoxIsThroughTheNearestFace) {
  const DopTree box = tree_of(geometry::make_box({1.0, 1.0, 1.0}, 48));
  for (const auto& [offset, depth] : {std::pair{Vector3d(0.9, 0.3, -0.2), 0.1},
                                      {Vector3d(0.2, -0.7, 0.5), 0.3},
                                      {Vector3d(0.4, 0.45, -0.95), 0.05}}) {
    const double found = depth_of(box, box, at(offset.x(), offset.y(), offset.z()));
    EXPECT_GE(found, depth * (1.0 - 1e-12)) << offset.transpose();
    EXPECT_LE(found, 1.01 * depth) << offset.transpose();
  }
}

TEST(WayOut, OfBallsIsAlongTheirCenters) {
  RecordProperty("seed", static_cast<int>(kPenetrationSeed));
  test_support::RandomNumbers random(kPenetrationSeed);
  const DopTree ball = tree_of(geometry::make_sphere(0.5, 2000));
  for (int i = 0; i < 20; ++i) {
    const double distance = random.uniform(0.5, 0.99);
    Isometry3d X_AB(random.rotation());
    X_AB.translation() = distance * random.direction();
    const double depth = 1.0 - distance;
    // Balls of triangles are a little smaller.
    const double found = depth_of(ball, ball, X_AB);
    EXPECT_LE(found, 1.05 * depth + 1e-3) << "seed " << kPenetrationSeed << ", case " << i;
    EXPECT_GE(found, depth - 0.01) << "seed " << kPenetrationSeed << ", case " << i;
  }
}

TEST(WayOut, BallInASheetLeavesToTheNearerSide) {
  const DopTree sheet = tree_of(geometry::make_plate({2.0, 2.0}, 200));
  const DopTree ball = tree_of(geometry::make_sphere(0.1, 2000));
  for (const double height : {0.06, -0.03}) {
    QueryWorkspace workspace;
    const Vector3d way_out = find_way_out(sheet, ball, at(0.0, 0.0, height), workspace).way_out_A;
    EXPECT_NEAR(way_out.norm(), 0.1 - std::abs(height), 1e-3);
    EXPECT_GT(way_out.z() * height, 0.0);
  }
}

TEST(WayOut, IsFoundForConcentricObjects) {
  const DopTree box = tree_of(geometry::make_box({1.0, 2.0, 3.0}, 48));
  EXPECT_NEAR(depth_of(box, box, Isometry3d::Identity()), 1.0, 0.02);
}

TEST(WayOut, OffCentrePegMovesToTheMiddleOfItsHole) {
  // The walls of a square hole of 2 × 2, 40 high, and a block in it that fits with 0.02 on each side. It is 0.6 too far
  // to one side, and 20 deep: to leave the hole is long, and along all other directions the free place is small.
  const DopTree hole = tree_of(geometry::make_box({2.0, 2.0, 40.0}, 48));
  const DopTree block = tree_of(geometry::make_box({1.96, 1.96, 30.0}, 48));
  EXPECT_NEAR(depth_of(hole, block, at(0.6, 0.0, 0.0)), 0.58, 1e-3);
  EXPECT_NEAR(depth_of(hole, block, at(0.6, -0.6, 0.0)), std::sqrt(2.0) * 0.58, 1e-3);
  geometry::TriangleMesh mesh = hole.mesh();
  const Isometry3d turned(test_support::turn(0.7, {1.0, 2.0, 3.0}));
  for (Vector3d& vertex : mesh.vertices)
    vertex = turned * vertex;
  EXPECT_NEAR(depth_of(tree_of(std::move(mesh)), block, turned * at(0.6)), 0.58, 1e-3) << "along the block's axes";
}

TEST(WayOut, IsTheSameOnASecondCall) {
  const DopTree box = tree_of(geometry::make_box({1.0, 1.0, 1.0}, 48));
  const DopTree ball = tree_of(geometry::make_sphere(0.4, 500));
  QueryWorkspace workspace;
  const Vector3d first = find_way_out(box, ball, at(0.5, 0.4, 0.3), workspace).way_out_A;
  EXPECT_EQ(find_way_out(box, ball, at(0.5, 0.4, 0.3), workspace).way_out_A, first);
}

TEST(WayOut, RefusesInvalidPosesAndClearances) {
  const DopTree box = tree_of(geometry::make_box({1.0, 1.0, 1.0}, 48));
  QueryWorkspace workspace;
  EXPECT_THROW(find_way_out(box, box, at(std::nan("")), workspace), std::invalid_argument);
  for (const double bad : {-1.0, std::nan(""), 2e9, 1e160})
    EXPECT_THROW(find_way_out(box, box, at(0.0), workspace, bad), std::invalid_argument);
  EXPECT_NO_THROW(find_way_out(box, box, at(0.0), workspace, 1e9));
}

}  // namespace
}  // namespace glissade::collision

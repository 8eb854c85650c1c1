// Peg and holed plate against closed forms: their gap is the difference of their radii, whatever the tessellation.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/peg_and_hole.h>

#include "enclosed_volume.h"
#include "expect_bad_input.h"
#include "trees.h"

namespace glissade::shapes {
namespace {

using Eigen::Isometry3d;
using std::numbers::pi;
using test_support::enclosed_volume;
using test_support::expect_bad_input;
using test_support::tree_of;

constexpr double kClearance = 52e-6;

// The peg's tip at the height z over the plate's upper face.
Isometry3d tip_at(double z, double angle = 0.0, double x = 0.0) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = Eigen::Vector3d(x, 0.0, z);
  return X;
}

class PegAndHole : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  PegShape peg() const { return {.segments = GetParam().first, .rows = GetParam().second}; }
  HoledPlateShape plate() const {
    return {.hole_radius = peg().radius + kClearance, .segments = peg().segments, .rows = peg().rows};
  }
};

TEST_P(PegAndHole, TheGapIsTheDifferenceOfTheRadiiAtAnyDepth) {
  const collision::DopTree peg_tree = tree_of(make_peg(peg()));
  const collision::DopTree plate_tree = tree_of(make_holed_plate(plate()));
  collision::QueryWorkspace workspace;
  for (const double depth : {1e-3, 4e-3, 12e-3}) {
    const auto gap = [&](const Isometry3d& X) {
      return collision::distance(plate_tree, peg_tree, X, workspace).distance;
    };
    EXPECT_NEAR(gap(tip_at(-depth)), kClearance, 1e-12);
    const double step = 2 * pi / peg().segments;
    EXPECT_NEAR(gap(tip_at(-depth, 3 * step)), kClearance, 1e-12);
    // Corners face facets; few corners reach through them.
    const double turned = plate().hole_radius - peg().radius / std::cos(pi / peg().segments);
    EXPECT_NEAR(gap(tip_at(-depth, 0.5 * step)), std::max(0.0, turned), 1e-12);
  }
}

TEST_P(PegAndHole, LateralPlayIsTheClearance) {
  const collision::DopTree peg_tree = tree_of(make_peg(peg()));
  const collision::DopTree plate_tree = tree_of(make_holed_plate(plate()));
  collision::QueryWorkspace workspace;
  // Facets face +x half a step away from the corner that lies there.
  const double to_facet = kClearance / std::cos(pi / peg().segments);
  EXPECT_FALSE(intersects(plate_tree, peg_tree, tip_at(-5e-3, 0.0, 0.999 * to_facet), workspace));
  EXPECT_TRUE(intersects(plate_tree, peg_tree, tip_at(-5e-3, 0.0, 1.001 * to_facet), workspace));
}

TEST_P(PegAndHole, MeshesAreClosedWithTheExactVolume) {
  const geometry::TriangleMesh peg_mesh = make_peg(peg());
  const geometry::MeshReport peg_report = geometry::report(peg_mesh);
  EXPECT_TRUE(peg_report.is_watertight);
  EXPECT_EQ(peg_report.inconsistent_edges, 0);
  EXPECT_EQ(peg_report.degenerate, 0);
  const double polygon = peg().segments * std::tan(pi / peg().segments);  // area of one with facets at distance 1
  const double r = peg().radius, c = peg().chamfer, n = r - c;
  EXPECT_NEAR(enclosed_volume(peg_mesh),
              polygon * (r * r * (peg().length - 2 * c) + 2 * c * (r * r + r * n + n * n) / 3), 1e-16);

  const geometry::TriangleMesh plate_mesh = make_holed_plate(plate());
  const geometry::MeshReport plate_report = geometry::report(plate_mesh);
  EXPECT_TRUE(plate_report.is_watertight);
  EXPECT_EQ(plate_report.inconsistent_edges, 0);
  EXPECT_EQ(plate_report.degenerate, 0);
  EXPECT_NEAR(enclosed_volume(plate_mesh),
              plate().thickness * (plate().size * plate().size - polygon * std::pow(plate().hole_radius, 2)), 1e-16);
  EXPECT_EQ(peg_report.triangles, 2 * peg().segments * (peg().rows + 3));
  EXPECT_EQ(plate_report.triangles, 2 * plate().segments * (plate().rows + 3));
}

INSTANTIATE_TEST_SUITE_P(Tessellations, PegAndHole,
                         ::testing::Values(std::pair{8, 1}, std::pair{64, 1}, std::pair{64, 40}, std::pair{256, 20}));

TEST(PegAndHoleErrors, NameTheArgumentAndItsValue) {
  expect_bad_input([] { make_peg({.radius = -1.0}); }, {"radius", "-1"});
  expect_bad_input([] { make_peg({.radius = 4e-3, .chamfer = 5e-3}); }, {"chamfer", "radius", "0.005"});
  expect_bad_input([] { make_peg({.segments = 2}); }, {"segments", "2"});
  expect_bad_input([] { make_peg({.rows = 0}); }, {"rows", "0"});
  expect_bad_input([] { make_holed_plate({.segments = 60}); }, {"segments", "multiple of 8", "60"});
  expect_bad_input([] { make_holed_plate({.hole_radius = 4e-3, .size = 8e-3}); }, {"size", "0.008"});
}

}  // namespace
}  // namespace glissade::shapes

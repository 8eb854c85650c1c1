#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/sheet_metal.h>

namespace glissade::shapes {
namespace {

using std::numbers::pi;

SheetMetal example() {
  SheetMetal sheet;
  sheet.size = {0.4, 0.3};
  sheet.corner_radius = 0.02;
  sheet.holes.push_back({{0.05, 0.02}, {0.12, 0.08}, 0.02});
  sheet.holes.push_back({{0.15, -0.1}, {0.008, 0.008}, 0.004});
  sheet.beads.push_back({{{-0.12, 0}, {0.02, 0.2}, 0.01}, 0.006, 0.003});
  return sheet;
}

TEST(SheetMetal, IsOneConformingSheetWithTwoHoles) {
  for (const std::int64_t count : {100, 4000, 20'000}) {
    const geometry::MeshReport r = geometry::report(make_sheet(example(), count));
    EXPECT_EQ(r.nonmanifold_edges, 0);
    EXPECT_EQ(r.inconsistent_edges, 0);
    EXPECT_EQ(r.degenerate, 0);
    EXPECT_EQ(r.components, 1);
    const std::int64_t edges = (3 * r.triangles + r.open_edges) / 2;
    EXPECT_EQ(r.vertices - edges + r.triangles, 1 - 2) << "a disc less two holes, no cracks";
    if (count >= 4000) {
      EXPECT_NEAR(static_cast<double>(r.triangles), static_cast<double>(count), 0.25 * static_cast<double>(count));
    }
  }
}

TEST(SheetMetal, BoundaryFollowsTheOutlines) {
  const SheetMetal sheet = example();
  const RoundedRectangle blank{Eigen::Vector2d::Zero(), sheet.size, sheet.corner_radius};
  const geometry::TriangleMesh mesh = make_sheet(sheet, 4000);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    EXPECT_LT(signed_distance(blank, p.head<2>()), 2e-7);
    for (const RoundedRectangle& hole : sheet.holes) {
      EXPECT_GT(signed_distance(hole, p.head<2>()), -2e-7);
    }
  }
  double expected = 0.4 * 0.3 - (4 - pi) * 0.02 * 0.02;
  expected -= 0.12 * 0.08 - (4 - pi) * 0.02 * 0.02;
  expected -= pi * 0.004 * 0.004;
  double projected = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto i = static_cast<std::int32_t>(t);
    const double doubled = (mesh.corner(i, 1) - mesh.corner(i, 0)).cross(mesh.corner(i, 2) - mesh.corner(i, 0)).z();
    EXPECT_GT(doubled, 0) << "every triangle faces up";
    projected += doubled / 2;
  }
  EXPECT_NEAR(projected, expected, 2e-5);
}

TEST(SheetMetal, BeadHasItsHeightAndTheRestIsExactlyFlat) {
  const SheetMetal sheet = example();
  const Bead& bead = sheet.beads.front();
  for (const std::int64_t count : {500, 4000}) {
    double highest = 0;
    for (const Eigen::Vector3d& p : make_sheet(sheet, count).vertices) {
      const double depth = -signed_distance(bead.foot, p.head<2>());
      if (depth < 0) {
        EXPECT_EQ(p.z(), 0);
      }
      EXPECT_NEAR(p.z(), std::clamp(depth / bead.flank_width, 0.0, 1.0) * bead.height, 1e-6);
      highest = std::max(highest, p.z());
    }
    EXPECT_EQ(highest, bead.height);
  }
}

TEST(SheetMetal, SunkBeadsGoTheOtherWay) {
  SheetMetal sheet = example();
  sheet.beads.front().height = -0.004;
  const geometry::MeshReport r = geometry::report(make_sheet(sheet, 2000));
  EXPECT_EQ(r.bounds.min().z(), -0.004);
  EXPECT_EQ(r.bounds.max().z(), 0);
}

TEST(SheetMetal, SignedDistanceOfARoundedRectangle) {
  const RoundedRectangle outline{{1, 2}, {4, 2}, 0.5};
  EXPECT_DOUBLE_EQ(signed_distance(outline, {1, 2}), -1);
  EXPECT_DOUBLE_EQ(signed_distance(outline, {4, 2}), 1);
  EXPECT_DOUBLE_EQ(signed_distance(outline, {1, 2.5}), -0.5);
  EXPECT_DOUBLE_EQ(signed_distance(outline, {3, 3}), 0.5 * (std::sqrt(2.0) - 1));
}

TEST(SheetMetal, RejectsInvalidGeometry) {
  SheetMetal sheet = example();
  sheet.holes.front().center.x() = 0.19;
  EXPECT_THROW(make_sheet(sheet, 1000), std::invalid_argument) << "hole over the edge";
  sheet = example();
  sheet.holes.front().corner_radius = 0.05;
  EXPECT_THROW(make_sheet(sheet, 1000), std::invalid_argument) << "corner radius beyond half the height";
  sheet = example();
  sheet.beads.front().flank_width = 0.01;
  EXPECT_THROW(make_sheet(sheet, 1000), std::invalid_argument) << "flanks meet";
  sheet = example();
  sheet.beads.front().height = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_sheet(sheet, 1000), std::invalid_argument);
  sheet = example();
  sheet.size.x() = -1;
  EXPECT_THROW(make_sheet(sheet, 1000), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::shapes

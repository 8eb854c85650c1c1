// A unit in its bay: clearances and overlaps are those asked for.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/slide_in_unit.h>

#include "enclosed_volume.h"
#include "expect_bad_input.h"
#include "poses.h"
#include "trees.h"

namespace glissade::shapes {
namespace {

using test_support::at;
using test_support::enclosed_volume;
using test_support::expect_bad_input;
using test_support::tree_of;

TEST(SlideInUnit, ClearanceIsConstantDuringInsertion) {
  for (const std::int64_t triangles : {30, 1000, 20'000}) {
    const SlideInShape shape{.triangles = triangles};
    const collision::DopTree unit = tree_of(make_slide_in_unit(shape));
    const collision::DopTree bay = tree_of(make_bay(shape));
    collision::QueryWorkspace workspace;
    for (const double out : {1e-3, 0.05, 0.12})
      EXPECT_NEAR(collision::distance(bay, unit, at(0.0, -out, 0.0), workspace).distance, shape.clearance, 1e-12);
    for (const double lift : {1e-6, 0.2e-3})
      EXPECT_NEAR(collision::distance(bay, unit, at(0.0, -lift, 0.0), workspace).distance, lift, 1e-12);
    EXPECT_TRUE(intersects(bay, unit, at(0.0, 0.0, 0.0), workspace)) << "the bezel lies on the flange";
    for (const double sign : {-1.0, 1.0}) {
      const double inside = 0.999 * sign * shape.clearance;
      const double outside = 1.001 * sign * shape.clearance;
      EXPECT_FALSE(intersects(bay, unit, at(inside, -1e-3, 0.0), workspace));
      EXPECT_TRUE(intersects(bay, unit, at(outside, -1e-3, 0.0), workspace));
      EXPECT_FALSE(intersects(bay, unit, at(0.0, -1e-3, inside), workspace));
      EXPECT_TRUE(intersects(bay, unit, at(0.0, -1e-3, outside), workspace));
    }
  }
}

TEST(SlideInUnit, EveryTongueReachesIntoTheSeatedUnitByTheOverlap) {
  const SlideInShape shape{.tongues_per_side = 3};
  const collision::DopTree unit = tree_of(make_slide_in_unit(shape));
  collision::QueryWorkspace workspace;
  const std::vector<geometry::TriangleMesh> tongues = make_bay_tongues(shape);
  ASSERT_EQ(tongues.size(), 6);
  for (std::size_t i = 0; i < tongues.size(); ++i) {
    const double side = i < 3 ? -1.0 : 1.0;  // where the tongue is
    const collision::DopTree tongue = tree_of(tongues[i]);
    EXPECT_TRUE(intersects(tongue, unit, at(0.0, 0.0, 0.0), workspace));
    EXPECT_TRUE(intersects(tongue, unit, at(-0.999 * side * shape.overlap, 0.0, 0.0), workspace));
    EXPECT_FALSE(intersects(tongue, unit, at(-1.001 * side * shape.overlap, 0.0, 0.0), workspace));
  }
}

TEST(SlideInUnit, TheBayWithTonguesTellsWhichTrianglesTheyAre) {
  const SlideInShape shape;
  const BayWithTongues bay = make_bay_with_tongues(shape);
  const geometry::TriangleMesh walls = make_bay(shape);
  ASSERT_EQ(bay.mesh.triangles.size(), walls.triangles.size() + bay.tongue_triangles.size());
  EXPECT_TRUE(std::is_sorted(bay.tongue_triangles.begin(), bay.tongue_triangles.end()));
  for (const std::int32_t triangle : bay.tongue_triangles) {
    // Of each tongue's triangles one corner at least is its crest.
    double nearest = 1.0;
    for (int corner = 0; corner < 3; ++corner)
      nearest = std::min(nearest, std::abs(bay.mesh.corner(triangle, corner).x()));
    EXPECT_NEAR(nearest, shape.width / 2 - shape.overlap, 1e-15);
  }
}

TEST(SlideInUnit, IsTwoClosedBoxes) {
  const SlideInShape shape;
  const geometry::TriangleMesh unit = make_slide_in_unit(shape);
  const geometry::MeshReport r = geometry::report(unit);
  EXPECT_TRUE(r.is_watertight);
  EXPECT_EQ(r.components, 2);
  EXPECT_NEAR(enclosed_volume(unit),
              shape.width * shape.height * shape.depth + shape.bezel_thickness *
                                                             (shape.width + 2 * shape.bezel_border) *
                                                             (shape.height + 2 * shape.bezel_border),
              1e-15);
  EXPECT_EQ(geometry::report(make_bay(shape)).degenerate, 0);
}

TEST(SlideInUnit, ErrorsNameTheArgumentAndItsValue) {
  expect_bad_input([] { make_slide_in_unit({.depth = -0.1}); }, {"depth", "-0.1"});
  expect_bad_input([] { make_bay({.clearance = 7e-3}); }, {"clearance", "bezel", "0.007"});
  expect_bad_input([] { make_bay_tongues({.overlap = 0.1}); }, {"overlap", "width", "0.1"});
  expect_bad_input([] { make_bay_tongues({.tongues_per_side = 0}); }, {"tongues_per_side", "0"});
}

}  // namespace
}  // namespace glissade::shapes

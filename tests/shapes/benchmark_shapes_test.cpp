#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/benchmark_shapes.h>

#include "expect_bad_input.h"
#include "sanitizers.h"

namespace glissade::shapes {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using test_support::affordable;
using test_support::expect_bad_input;

const BenchmarkShape& shape_named(const std::string& name) {
  const auto& shapes = benchmark_shapes();
  return *std::find_if(shapes.begin(), shapes.end(), [&](const BenchmarkShape& shape) { return shape.name == name; });
}

/// The smallest ratio of a triangle's height to its longest edge: 0 where a triangle is without area.
double flattest(const geometry::TriangleMesh& mesh) {
  double smallest = 1;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    const Vector3d ab = mesh.corner(t, 1) - mesh.corner(t, 0);
    const Vector3d ac = mesh.corner(t, 2) - mesh.corner(t, 0);
    const double longest = std::max({ab.norm(), ac.norm(), (ab - ac).norm()});
    smallest = std::min(smallest, ab.cross(ac).norm() / (longest * longest));
  }
  return smallest;
}

/// The part of the triangles whose centroid lies deeper than `depth` within the bounds.
double interior_part(const geometry::TriangleMesh& mesh, double depth) {
  const AlignedBox3d bounds = geometry::bounds_of(mesh);
  int interior = 0;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    const Vector3d centroid = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
    const double to_border = std::min((centroid - bounds.min()).minCoeff(), (bounds.max() - centroid).minCoeff());
    if (to_border > depth) ++interior;
  }
  return interior / static_cast<double>(mesh.triangles.size());
}

TEST(BenchmarkShapes, TheSuiteIsThatOfThePaper) {
  std::vector<std::string> names;
  for (const BenchmarkShape& shape : benchmark_shapes()) {
    names.push_back(shape.name);
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"headlight", "door-lock", "car-body", "hose", "sphere", "hyperboloid", "torus"}));
}

TEST(BenchmarkShapes, TriangleCountIsAboutAsRequestedWithoutDegenerates) {
  for (const BenchmarkShape& shape : benchmark_shapes()) {
    // Just below and above the count from which small details are shown, too.
    for (const std::int64_t count : {1'000, 2'500, 7'999, 8'000, 25'000, affordable(200'000)}) {
      SCOPED_TRACE(shape.name + " of " + std::to_string(count));
      const geometry::TriangleMesh mesh = shape.make(count);
      EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), static_cast<double>(count),
                  0.15 * static_cast<double>(count));
      EXPECT_GT(flattest(mesh), 1e-6);
    }
  }
}

TEST(BenchmarkShapes, NoDegenerateDuplicateOrNonmanifoldTriangles) {
  for (const BenchmarkShape& shape : benchmark_shapes()) {
    SCOPED_TRACE(shape.name);
    const geometry::MeshReport r = geometry::report(shape.make(10'000));
    EXPECT_EQ(r.degenerate, 0);
    EXPECT_EQ(r.duplicates, 0);
    EXPECT_EQ(r.nonmanifold_edges, 0);
  }
}

TEST(BenchmarkShapes, HaveTheSizesOfTheirModels) {
  struct Expected {
    std::string name;
    Vector3d size;
  };
  const std::vector<Expected> expected{{"headlight", {0.52, 0.235, 0.223}},
                                       {"door-lock", {0.128, 0.104, 0.049}},
                                       {"car-body", {4.14, 2.04, 1.24}},
                                       {"hose", {0.627, 0.27, 0.298}},
                                       {"sphere", {1, 1, 1}},
                                       {"hyperboloid", {1, 1, 1}},
                                       {"torus", {1, 1, 0.3}}};
  for (const Expected& e : expected) {
    for (const std::int64_t count : {8'000, 8'000 + affordable(100'000)}) {
      const Vector3d size = geometry::bounds_of(shape_named(e.name).make(count)).sizes();
      EXPECT_LT(((size - e.size).array() / e.size.array()).abs().maxCoeff(), 0.03)
          << e.name << " of " << count << ": " << size.transpose();
    }
  }
}

TEST(BenchmarkShapes, KeepTheirShapeWhileTheyAreRefined) {
  for (const BenchmarkShape& shape : benchmark_shapes()) {
    SCOPED_TRACE(shape.name);
    const geometry::MeshReport coarse = geometry::report(shape.make(10'000));
    const geometry::MeshReport fine = geometry::report(shape.make(40'000));
    EXPECT_EQ(coarse.components, fine.components);
    EXPECT_NEAR(coarse.area, fine.area, 0.03 * fine.area);
  }
}

TEST(BenchmarkShapes, CarPartsConsistOfManyComponents) {
  for (const auto* name : {"headlight", "door-lock", "car-body"}) {
    EXPECT_GE(geometry::report(shape_named(name).make(1'000)).components, 15) << name;
    EXPECT_GE(geometry::report(shape_named(name).make(20'000)).components, 100) << name;
  }
  EXPECT_GE(geometry::report(shape_named("hose").make(20'000)).components, 20);
}

TEST(BenchmarkShapes, MostOfTheDoorLockIsInside) {
  EXPECT_GT(interior_part(make_door_lock(20'000), 0.003), 0.7);
}

TEST(BenchmarkShapes, TheCarIsOpenAtItsWindowsAndWheels) {
  // Lines across the car: through both front windows, over both seats' heads; and through a wheel arch from outside to
  // its inner wall. A thin box stands for a line.
  const geometry::TriangleMesh car = make_car_body(20'000);
  const auto hits_between = [&](double x, double y_low, double y_high, double z) {
    const AlignedBox3d line(Vector3d(x - 0.01, y_low, z - 0.01), Vector3d(x + 0.01, y_high, z + 0.01));
    int hits = 0;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(car.triangles.size()); ++t) {
      AlignedBox3d box(car.corner(t, 0));
      box.extend(car.corner(t, 1));
      box.extend(car.corner(t, 2));
      if (box.intersects(line)) ++hits;
    }
    return hits;
  };
  EXPECT_EQ(hits_between(0.15, -1, 1, 1.05), 0);
  EXPECT_EQ(hits_between(1.3, 0.6, 1, 0.4), 0);
  EXPECT_GT(hits_between(1.3, 0.3, 0.6, 0.4), 0) << "the inner wall of the wheel housing";
  EXPECT_GT(hits_between(0.3, 0.6, 1, 0.6), 0) << "the door";
}

TEST(BenchmarkShapes, EqualRequestsGiveEqualMeshes) {
  for (const BenchmarkShape& shape : benchmark_shapes()) {
    const geometry::TriangleMesh first = shape.make(9'000);
    const geometry::TriangleMesh second = shape.make(9'000);
    EXPECT_EQ(first.triangles, second.triangles) << shape.name;
    EXPECT_EQ(first.vertices, second.vertices) << shape.name;
  }
}

TEST(BenchmarkShapes, RejectCountsOutOfRange) {
  for (const BenchmarkShape& shape : benchmark_shapes()) {
    expect_bad_input([&] { shape.make(0); }, {"triangle_count", "0"});
    expect_bad_input([&] { shape.make(60'000'000); }, {"triangle_count", "60000000"});
  }
}

TEST(BumpyPlate, HeightMatchesTheBumpHeight) {
  const geometry::TriangleMesh plate = make_bumpy_plate({0.4, 0.2}, 0.01, 3, 20'000);
  EXPECT_NEAR(static_cast<double>(plate.triangles.size()), 20'000, 1'000);
  const AlignedBox3d bounds = geometry::bounds_of(plate);
  EXPECT_NEAR(bounds.sizes().x(), 0.4, 1e-15);
  EXPECT_NEAR(bounds.sizes().y(), 0.2, 1e-15);
  EXPECT_LE(bounds.max().z(), 0.005);
  EXPECT_GT(bounds.max().z(), 0.0049);
  EXPECT_LT(bounds.min().z(), -0.0049);
  const geometry::MeshReport r = geometry::report(plate);
  EXPECT_EQ(r.components, 1);
  EXPECT_EQ(r.degenerate, 0);
}

TEST(BumpyPlate, TwoOfThemAreCloseEverywhereAndTouchNowhere) {
  const collision::DopTree tree(
      std::make_shared<const geometry::TriangleMesh>(make_bumpy_plate({0.2, 0.2}, 0.01, 4, 2'000)));
  const double gap = 1e-4;
  const Eigen::Isometry3d X_LowerUpper(Eigen::Translation3d(0, 0, gap));
  collision::QueryWorkspace workspace;
  EXPECT_FALSE(intersects(tree, tree, X_LowerUpper, workspace));
  EXPECT_TRUE(intersects(tree, tree, Eigen::Isometry3d(Eigen::Translation3d(0.01, 0, gap)), workspace));
}

TEST(BumpyPlate, RejectsArgumentsOutOfRange) {
  const Eigen::Vector2d size(0.2, 0.2);
  expect_bad_input([&] { make_bumpy_plate({0, 0.2}, 0.01, 4, 2'000); }, {"size", "0"});
  expect_bad_input([&] { make_bumpy_plate(size, -0.01, 4, 2'000); }, {"bump_height", "-0.01"});
  expect_bad_input([&] { make_bumpy_plate(size, std::numeric_limits<double>::quiet_NaN(), 4, 2'000); },
                   {"bump_height"});
  expect_bad_input([&] { make_bumpy_plate(size, 0.01, 0, 2'000); }, {"wave_count", "0"});
  expect_bad_input([&] { make_bumpy_plate(size, 0.01, 4, 0); }, {"triangle_count", "0"});
}

}  // namespace
}  // namespace glissade::shapes

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_topology.h>

#include "enclosed_volume.h"

namespace glissade::geometry {
namespace {

using std::numbers::pi;
using test_support::enclosed_volume;

/// Vertices - edges + triangles; edges are those of two triangles and the open ones.
std::int64_t euler_characteristic(const MeshReport& r) {
  const std::int64_t edges = (3 * r.triangles - r.open_edges) / 2 + r.open_edges;
  return r.vertices - edges + r.triangles;
}

void expect_sound(const MeshReport& r, std::int64_t triangle_count) {
  EXPECT_NEAR(static_cast<double>(r.triangles), static_cast<double>(triangle_count),
              0.25 * static_cast<double>(triangle_count));
  EXPECT_EQ(r.degenerate, 0);
  EXPECT_EQ(r.duplicates, 0);
  EXPECT_EQ(r.nonmanifold_edges, 0);
  EXPECT_EQ(r.inconsistent_edges, 0);
  EXPECT_EQ(r.components, 1);
}

TEST(MeshGenerators, SphereIsClosedAndRound) {
  for (const std::int64_t count : {200, 5000, 50'000}) {
    const TriangleMesh mesh = make_sphere(0.05, count);
    const MeshReport r = report(mesh);
    expect_sound(r, count);
    EXPECT_TRUE(r.is_watertight);
    EXPECT_EQ(euler_characteristic(r), 2);
    for (const Eigen::Vector3d& p : mesh.vertices) {
      EXPECT_NEAR(p.norm(), 0.05, 1e-15);
    }
    EXPECT_NEAR(r.area, 4 * pi * 0.05 * 0.05, 0.05 * r.area);
    EXPECT_NEAR(enclosed_volume(mesh), 4 * pi / 3 * std::pow(0.05, 3), 0.1 * enclosed_volume(mesh)) << "faces outward";
  }
}

TEST(MeshGenerators, TorusHasOneHandle) {
  const TriangleMesh mesh = make_torus(0.1, 0.03, 4000);
  const MeshReport r = report(mesh);
  expect_sound(r, 4000);
  EXPECT_TRUE(r.is_watertight);
  EXPECT_EQ(euler_characteristic(r), 0);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    EXPECT_NEAR(std::hypot(p.head<2>().norm() - 0.1, p.z()), 0.03, 1e-15);
  }
  EXPECT_NEAR(r.area, 4 * pi * pi * 0.1 * 0.03, 0.01 * r.area);
  EXPECT_NEAR(enclosed_volume(mesh), 2 * pi * pi * 0.1 * 0.03 * 0.03, 0.02 * enclosed_volume(mesh));
}

TEST(MeshGenerators, HyperboloidIsOpenAtBothEnds) {
  const TriangleMesh mesh = make_hyperboloid(0.05, 0.1, 0.2, 4000);
  const MeshReport r = report(mesh);
  expect_sound(r, 4000);
  EXPECT_EQ(euler_characteristic(r), 0);
  EXPECT_GT(r.open_edges, 0);
  const double c_squared = 0.1 * 0.1 / (0.1 * 0.1 / (0.05 * 0.05) - 1);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    EXPECT_NEAR(p.head<2>().squaredNorm() / (0.05 * 0.05) - p.z() * p.z() / c_squared, 1, 1e-12);
  }
  EXPECT_NEAR(r.bounds.sizes().z(), 0.2, 1e-15);
}

TEST(MeshGenerators, BoxOfTwelveTrianglesAndFinelyTessellated) {
  const Eigen::Vector3d size(0.1, 0.2, 0.05);
  const MeshReport coarse = report(make_box(size, 12));
  EXPECT_EQ(coarse.triangles, 12);
  EXPECT_EQ(coarse.vertices, 8);
  const TriangleMesh mesh = make_box(size, 5000);
  const MeshReport fine = report(mesh);
  expect_sound(fine, 5000);
  for (const MeshReport& r : {coarse, fine}) {
    EXPECT_TRUE(r.is_watertight);
    EXPECT_EQ(euler_characteristic(r), 2);
    EXPECT_NEAR(r.area, 0.07, 1e-12);
    EXPECT_EQ(r.bounds.sizes(), size);
  }
  EXPECT_NEAR(enclosed_volume(mesh), size.prod(), 1e-12);
}

TEST(MeshGenerators, PlateIsFlatAndFacesUp) {
  const TriangleMesh mesh = make_plate({0.3, 0.2}, 1200);
  const MeshReport r = report(mesh);
  expect_sound(r, 1200);
  EXPECT_EQ(euler_characteristic(r), 1);
  EXPECT_NEAR(r.area, 0.06, 1e-12);
  EXPECT_EQ(r.bounds.min().z(), 0);
  EXPECT_EQ(r.bounds.max().z(), 0);
  const Eigen::Vector3d normal = (mesh.corner(0, 1) - mesh.corner(0, 0)).cross(mesh.corner(0, 2) - mesh.corner(0, 0));
  EXPECT_GT(normal.z(), 0);
}

TEST(MeshGenerators, TubeIsAShell) {
  const TriangleMesh mesh = make_tube(0.016, 0.8, 3000);
  const MeshReport r = report(mesh);
  expect_sound(r, 3000);
  EXPECT_EQ(euler_characteristic(r), 0);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    EXPECT_NEAR(p.head<2>().norm(), 0.016, 1e-15);
  }
  EXPECT_NEAR(r.area, 2 * pi * 0.016 * 0.8, 0.02 * r.area);
}

TEST(MeshGenerators, HoseThroughPointsOfACircleIsAboutAQuarterTorus) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= 8; ++i) {
    const double angle = pi / 2 * i / 8;
    points.emplace_back(0.2 * std::cos(angle), 0.2 * std::sin(angle), 0);
  }
  const TriangleMesh mesh = make_hose(points, 0.01, 6000);
  const MeshReport r = report(mesh);
  expect_sound(r, 6000);
  EXPECT_EQ(euler_characteristic(r), 0);
  EXPECT_NEAR(r.area, 2 * pi * 0.01 * (pi / 2 * 0.2), 0.02 * r.area);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    EXPECT_NEAR(std::hypot(p.head<2>().norm() - 0.2, p.z()), 0.01, 1e-3);
  }
}

TEST(MeshGenerators, StraightHoseIsATube) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {0, 0, 0.1}, {0, 0, 0.15}, {0, 0, 0.4}};
  const TriangleMesh mesh = make_hose(points, 0.01, 1000);
  for (const Eigen::Vector3d& p : mesh.vertices) {
    EXPECT_NEAR(p.head<2>().norm(), 0.01, 1e-12);
  }
  const MeshReport r = report(mesh);
  EXPECT_NEAR(r.bounds.min().z(), 0, 1e-12);
  EXPECT_NEAR(r.bounds.max().z(), 0.4, 1e-12);
}

TEST(MeshGenerators, RevolutionClosesAtTheAxisAndFacesOutward) {
  const std::vector<Eigen::Vector2d> profile{{0, 0}, {0.02, 0}, {0.02, 0.05}, {0, 0.05}};
  const TriangleMesh mesh = make_revolution(profile, false, 64);
  EXPECT_TRUE(report(mesh).is_watertight);
  EXPECT_EQ(euler_characteristic(report(mesh)), 2);
  EXPECT_NEAR(enclosed_volume(mesh), pi * 0.02 * 0.02 * 0.05, 0.01 * enclosed_volume(mesh));
}

TEST(MeshGenerators, RejectsSizesAndCountsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_sphere(0, 100), std::invalid_argument);
  EXPECT_THROW(make_sphere(nan, 100), std::invalid_argument);
  EXPECT_THROW(make_sphere(0.1, 0), std::invalid_argument);
  EXPECT_THROW(make_sphere(0.1, 100'000'000), std::invalid_argument);
  EXPECT_THROW(make_torus(0.1, 0.1, 100), std::invalid_argument);
  EXPECT_THROW(make_hyperboloid(0.1, 0.1, 0.2, 100), std::invalid_argument);
  EXPECT_THROW(make_box({0.1, -0.1, 0.1}, 100), std::invalid_argument);
  EXPECT_THROW(make_plate({0.1, std::numeric_limits<double>::infinity()}, 100), std::invalid_argument);
  EXPECT_THROW(make_tube(0.1, 0, 100), std::invalid_argument);
  const std::vector<Eigen::Vector3d> one_point{{0, 0, 0}};
  EXPECT_THROW(make_hose(one_point, 0.1, 100), std::invalid_argument);
  const std::vector<Eigen::Vector3d> twice{{0, 0, 0}, {0, 0, 0}};
  EXPECT_THROW(make_hose(twice, 0.1, 100), std::invalid_argument);
}

TEST(MeshGenerators, ASmallestRequestStillGivesTheSurface) {
  EXPECT_TRUE(report(make_sphere(1, 1)).is_watertight);
  EXPECT_TRUE(report(make_torus(1, 0.3, 1)).is_watertight);
  EXPECT_EQ(make_box({1, 1, 1}, 1).triangles.size(), 12U);
  EXPECT_EQ(make_plate({1, 1}, 1).triangles.size(), 2U);
}

}  // namespace
}  // namespace glissade::geometry

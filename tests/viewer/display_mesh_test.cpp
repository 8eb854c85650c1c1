// Meshes as a graphics card gets them.

#include "model/display_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

namespace glissade::viewer {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kAll = 10'000'000;

Eigen::Vector3d place(const DisplayMesh& mesh, std::size_t vertex) {
  const auto& position = mesh.positions[vertex];
  return mesh.lower + mesh.step * Eigen::Vector3d(position[0], position[1], position[2]);
}

Eigen::Vector3d normal(const DisplayMesh& mesh, std::size_t vertex) {
  const auto& n = mesh.normals[vertex];
  return Eigen::Vector3d(n[0], n[1], n[2]) / 127.0;
}

TEST(DisplayMesh, ABoxHasSharpEdges) {
  const DisplayMesh mesh = display_mesh(geometry::make_box({0.2, 0.3, 0.4}, 12), kAll);
  EXPECT_EQ(mesh.triangles(), 12u);
  EXPECT_EQ(mesh.positions.size(), 24u);  // each corner once for each of its faces
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_NEAR(normal(mesh, v).cwiseAbs().maxCoeff(), 1.0, 0.01);
}

TEST(DisplayMesh, SharpEdgesAndRimsAreDrawn) {
  EXPECT_EQ(display_mesh(geometry::make_box({0.2, 0.3, 0.4}, 12), kAll).edges.size(), 2u * 12u);
  EXPECT_TRUE(display_mesh(geometry::make_sphere(0.05, 5000), kAll).edges.empty());
  const geometry::TriangleMesh sheet = geometry::make_plate({0.2, 0.2}, 2);
  EXPECT_EQ(display_mesh(sheet, kAll).edges.size(), 2u * 4u);
}

TEST(DisplayMesh, ASphereIsSmoothWhateverTheOrientationOfItsTriangles) {
  const geometry::TriangleMesh sphere = geometry::flip_randomly(geometry::make_sphere(0.05, 5000), 3);
  const DisplayMesh mesh = display_mesh(sphere, kAll);
  // The two sides of each vertex, but not one vertex for each of its triangles.
  EXPECT_LE(mesh.positions.size(), 2 * sphere.vertices.size() + sphere.vertices.size() / 5);
  const double limit = std::cos(6.0 * std::numbers::pi / 180.0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_GT(std::abs(normal(mesh, v).dot(place(mesh, v).normalized())), limit) << v;
}

TEST(DisplayMesh, VerticesMoveByHalfAStepOfTheGridAtMost) {
  const geometry::TriangleMesh sphere = geometry::make_sphere(0.05, 2000);
  const DisplayMesh mesh = display_mesh(sphere, kAll);
  EXPECT_NEAR(mesh.step, 0.1 / 65535.0, 1e-8);
  ASSERT_EQ(mesh.triangles(), sphere.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d moved = place(mesh, mesh.indices[3 * t + static_cast<std::size_t>(i)]) -
                                    sphere.corner(static_cast<std::int32_t>(t), i);
      EXPECT_LE(moved.cwiseAbs().maxCoeff(), 0.501 * mesh.step);
    }
  }
}

TEST(DisplayMesh, ALargeMeshKeepsItsShapeWithFewerTriangles) {
  const DisplayMesh mesh = display_mesh(geometry::make_sphere(0.05, 60'000), 3000);
  EXPECT_LE(mesh.triangles(), 3750u);
  EXPECT_GE(mesh.triangles(), 1500u);
  for (const std::uint32_t vertex : mesh.indices)
    EXPECT_NEAR(place(mesh, vertex).norm(), 0.05, 1e-3);
}

TEST(DisplayMesh, TrianglesThatNothingCanJoinGetFewerToo) {
  const auto cell = [](int i) -> Eigen::Vector3d {
    const int y = i / 10 % 10;
    const int z = i / 100;
    return 0.01 * Eigen::Vector3d(i % 10, y, z);
  };
  geometry::TriangleMesh crumbs;
  for (int i = 0; i < 2000; ++i) {
    const auto first = static_cast<std::int32_t>(crumbs.vertices.size());
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.02, 0.0, 0.0), Eigen::Vector3d(0.0, 0.02, 0.0)})
      crumbs.vertices.push_back(corner + cell(i));
    crumbs.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_LE(display_mesh(crumbs, 500).triangles(), 625u);
}

TEST(DisplayMesh, OfASmallerMeshTheLongestEdgesAreDrawn) {
  // Loose triangles of a millimetre, 3 rims each, on a plate of 10 cm.
  geometry::TriangleMesh mesh = geometry::make_plate({0.1, 0.1}, 2);
  for (int i = 0; i < 2000; ++i) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    const int row = i / 50;
    const Eigen::Vector3d place(0.002 * (i % 50 - 25), 0.002 * (row - 20), 0.01);
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d::Zero().eval(), Eigen::Vector3d(1e-3, 0.0, 0.0), Eigen::Vector3d(0.0, 1e-3, 0.0)})
      mesh.vertices.push_back(place + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(display_mesh(mesh, kAll).edges.size(), 2u * 6004u);
  const DisplayMesh small = display_mesh(mesh, 400);
  ASSERT_EQ(small.edges.size(), 2u * 124u);
  int long_edges = 0;
  for (std::size_t e = 0; e < small.edges.size(); e += 2) {
    const auto& [from, to] = std::pair(small.edges[e], small.edges[e + 1]);
    const double length = small.step * std::hypot(from[0] - to[0], from[1] - to[1]);
    long_edges += length > 0.099 ? 1 : 0;
  }
  EXPECT_EQ(long_edges, 4) << "the rims of the plate";
}

/// Triangles round the origin whose normals lean by about 11° to one side and the other in turn.
geometry::TriangleMesh corrugated_fan(int triangles) {
  geometry::TriangleMesh fan;
  fan.vertices.push_back(Vector3d::Zero());
  const double lean = 0.2 * std::sin(2.0 * std::numbers::pi / triangles);
  for (int i = 0; i < triangles; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / triangles;
    fan.vertices.emplace_back(std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.0 : lean);
  }
  for (std::int32_t i = 0; i < triangles; ++i)
    fan.triangles.push_back({0, i + 1, (i + 1) % triangles + 1});
  return fan;
}

/// How far the normals at the origin are from those of their triangles at most, as cosines.
double least_agreement_in_the_middle(const geometry::TriangleMesh& fan) {
  const DisplayMesh mesh = display_mesh(fan, kAll);
  double least = 1.0;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const auto number = static_cast<std::int32_t>(t);
    const Vector3d own = fan.corner(number, 1).cross(fan.corner(number, 2)).normalized();
    least = std::min(least, normal(mesh, mesh.indices[3 * t]).dot(own));
  }
  return least;
}

// To look at all neighbors of each triangle of a fan would take the square of their number.
TEST(DisplayMesh, NormalsInALargeFanIgnoreNeighbors) {
  const double tenth = std::cos(0.1);
  EXPECT_LT(least_agreement_in_the_middle(corrugated_fan(64)), tenth) << "the mean, which leans to no side";
  EXPECT_GT(least_agreement_in_the_middle(corrugated_fan(66)), tenth) << "their own";
  EXPECT_GT(least_agreement_in_the_middle(corrugated_fan(100'000)), tenth);
}

TEST(DisplayMesh, NothingIsShownOfAMeshWithoutTriangles) {
  EXPECT_EQ(display_mesh({}, kAll).triangles(), 0u);
}

}  // namespace
}  // namespace glissade::viewer

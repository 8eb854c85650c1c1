#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {
namespace {

TEST(MeshOperations, MergeKeepsPartsSeparate) {
  const std::vector<TriangleMesh> parts{make_box({1, 1, 1}, 12), make_sphere(1, 200)};
  const MeshReport merged = report(merge(parts));
  EXPECT_EQ(merged.components, 2);
  EXPECT_TRUE(merged.is_watertight);
  EXPECT_NEAR(merged.area, report(parts[0]).area + report(parts[1]).area, 1e-12);
}

TEST(MeshOperations, TransformedMovesEveryVertex) {
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  X_AB.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()));
  X_AB.pretranslate(Eigen::Vector3d(1, 2, 3));
  const TriangleMesh mesh_B = make_box({1, 2, 3}, 12);
  const TriangleMesh mesh_A = transformed(mesh_B, X_AB);
  EXPECT_EQ(mesh_A.triangles, mesh_B.triangles);
  for (std::size_t i = 0; i < mesh_B.vertices.size(); ++i) {
    EXPECT_TRUE(mesh_A.vertices[i].isApprox(X_AB * mesh_B.vertices[i]));
  }
}

TEST(MeshOperations, FlipRandomlyTurnsAboutHalfOfTheTriangles) {
  const TriangleMesh mesh = make_plate({1, 1}, 2000);
  const TriangleMesh flipped = flip_randomly(mesh, 7);
  std::size_t turned = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (flipped.triangles[t] != mesh.triangles[t]) ++turned;
    EXPECT_TRUE(
        std::is_permutation(flipped.triangles[t].begin(), flipped.triangles[t].end(), mesh.triangles[t].begin()));
  }
  EXPECT_NEAR(static_cast<double>(turned), 1000, 150) << "seed 7";
  EXPECT_EQ(flip_randomly(mesh, 7).triangles, flipped.triangles);
  EXPECT_NE(flip_randomly(mesh, 8).triangles, flipped.triangles);
}

TEST(MeshOperations, WeldJoinsIdenticalPositionsOnly) {
  TriangleMesh soup;
  soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, -0.0}, {1, 1, 0}, {0, 1, 1e-300}, {9, 9, 9}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  const TriangleMesh welded = weld(soup);
  EXPECT_EQ(welded.vertices.size(), 5U) << "one shared vertex; one differs by very little; one is unused";
  const std::vector<Triangle> expected{{0, 1, 2}, {1, 3, 4}};
  EXPECT_EQ(welded.triangles, expected);
}

TEST(MeshOperations, ABoxTakesOnlyTrianglesThatItHoldsWhole) {
  const TriangleMesh mesh = make_plate({1, 1}, 2000);
  const Eigen::AlignedBox3d right_half(Eigen::Vector3d(0.0, -1.0, -1.0), Eigen::Vector3d(1.0, 1.0, 1.0));
  const std::vector<std::int32_t> inside = triangles_inside(mesh, right_half);
  EXPECT_NEAR(static_cast<double>(inside.size()), 1000, 100);
  EXPECT_EQ(bounds_of(mesh).sizes(), Eigen::Vector3d(1.0, 1.0, 0.0));
  const TriangleMesh left = without_triangles(mesh, inside);
  ASSERT_EQ(left.triangles.size(), mesh.triangles.size()) << "the others keep their numbers";
  for (std::int32_t t = 0; t < std::ssize(left.triangles); ++t) {
    const double least = std::min({mesh.corner(t, 0).x(), mesh.corner(t, 1).x(), mesh.corner(t, 2).x()});
    const double area = (left.corner(t, 1) - left.corner(t, 0)).cross(left.corner(t, 2) - left.corner(t, 0)).norm();
    EXPECT_EQ(area == 0.0, least >= 0.0) << "triangle " << t;
  }
}

}  // namespace
}  // namespace glissade::geometry

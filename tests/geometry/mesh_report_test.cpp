#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_topology.h>

namespace glissade::geometry {
namespace {

TriangleMesh two_triangles(const Triangle& second) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, second};
  return mesh;
}

TEST(MeshReport, OpenSheetOfTwoTriangles) {
  const MeshReport r = report(two_triangles({1, 3, 2}));
  EXPECT_EQ(r.vertices, 5);
  EXPECT_EQ(r.triangles, 2);
  EXPECT_EQ(r.open_edges, 4);
  EXPECT_EQ(r.inconsistent_edges, 0);
  EXPECT_EQ(r.components, 1);
  EXPECT_FALSE(r.is_watertight);
  EXPECT_DOUBLE_EQ(r.area, 1);
  EXPECT_EQ(r.bounds.max(), Eigen::Vector3d(1, 1, 0)) << "the unused vertex does not count";
}

TEST(MeshReport, InconsistentOrientation) {
  EXPECT_EQ(report(two_triangles({2, 3, 1})).inconsistent_edges, 1);
}

TEST(MeshReport, DuplicatesInWhateverOrder) {
  EXPECT_EQ(report(two_triangles({2, 1, 0})).duplicates, 1);
  EXPECT_EQ(report(two_triangles({1, 2, 0})).duplicates, 1);
}

TEST(MeshReport, DegenerateTrianglesAreCountedAndLeftOut) {
  const MeshReport r = report(two_triangles({1, 3, 3}));
  EXPECT_EQ(r.degenerate, 1);
  EXPECT_EQ(r.triangles, 2);
  EXPECT_EQ(r.open_edges, 3);
}

TEST(MeshReport, FinOnASheetIsNonManifold) {
  TriangleMesh mesh = two_triangles({1, 3, 2});
  mesh.triangles.push_back({1, 2, 4});
  const MeshReport r = report(mesh);
  EXPECT_EQ(r.nonmanifold_edges, 1);
  EXPECT_EQ(r.open_edges, 6);
}

TEST(MeshReport, ComponentsAreConnectedThroughVertices) {
  TriangleMesh mesh = two_triangles({2, 3, 4});
  EXPECT_EQ(report(mesh).components, 1);
  mesh.vertices.insert(mesh.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  mesh.triangles.push_back({5, 6, 7});
  EXPECT_EQ(report(mesh).components, 2);
}

TEST(MeshReport, ASphereIsWatertightAndAnEmptyMeshIsNot) {
  EXPECT_TRUE(report(make_sphere(1, 100)).is_watertight);
  const MeshReport empty = report(TriangleMesh{});
  EXPECT_FALSE(empty.is_watertight);
  EXPECT_TRUE(empty.bounds.isEmpty());
}

TEST(MeshReport, RejectsAnIndexOutOfRange) {
  EXPECT_THROW(report(two_triangles({0, 1, 5})), std::invalid_argument);
  EXPECT_THROW(report(two_triangles({0, 1, -1})), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::geometry

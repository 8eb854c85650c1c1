#include <algorithm>

#include <gtest/gtest.h>

#include <glissade/collision/mesh_generators.h>
#include <glissade/collision/mesh_operations.h>
#include <glissade/collision/mesh_topology.h>

namespace glissade::collision {
namespace {

std::int64_t count_edges(const MeshTopology& topology, bool flat) {
  return std::count_if(topology.edges().begin(), topology.edges().end(),
                       [&](const MeshTopology::Edge& edge) { return edge.flat == flat; });
}

std::int64_t count_vertices(const MeshTopology& topology, const TriangleMesh& mesh, bool flat) {
  std::int64_t count = 0;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices.size()); ++v) {
    count += topology.is_flat(v) == flat ? 1 : 0;
  }
  return count;
}

TEST(MeshTopology, OfABoxHasTwelveSharpEdgesAndSixFlatDiagonals) {
  const TriangleMesh box = make_box({0.1, 0.2, 0.3}, 12);
  const MeshTopology topology(box);
  EXPECT_EQ(count_edges(topology, false), 12);
  EXPECT_EQ(count_edges(topology, true), 6);
  EXPECT_EQ(count_vertices(topology, box, false), 8);
}

TEST(MeshTopology, IsBlindToTheOrientationOfTriangles) {
  const TriangleMesh sphere = make_sphere(0.1, 500);
  const TriangleMesh flipped = flip_randomly(make_plate({1.0, 1.0}, 200), 5);
  EXPECT_EQ(count_edges(MeshTopology(flipped), true), count_edges(MeshTopology(make_plate({1.0, 1.0}, 200)), true));
  EXPECT_EQ(count_edges(MeshTopology(flip_randomly(sphere, 5)), false), count_edges(MeshTopology(sphere), false));
}

TEST(MeshTopology, OnlyTheRimOfASheetCanStopAnything) {
  const TriangleMesh sheet = make_plate({1.0, 1.0}, 200);  // 10 × 10 cells
  const MeshTopology topology(sheet);
  EXPECT_EQ(count_edges(topology, false), 40);
  EXPECT_EQ(count_vertices(topology, sheet, true), 81);
}

TEST(MeshTopology, AFoldIsNotFlatThoughItsTrianglesAreCoplanar) {
  TriangleMesh fold;
  fold.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  fold.triangles = {{0, 1, 2}, {1, 0, 3}};  // both lie above the edge 0–1
  EXPECT_EQ(count_edges(MeshTopology(fold), true), 0);
}

TEST(MeshTopology, WhereThreeTrianglesMeetNothingIsFlat) {
  TriangleMesh fin;
  fin.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  fin.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const MeshTopology topology(fin);
  EXPECT_EQ(count_edges(topology, true), 0);
  EXPECT_EQ(topology.apexes_of(topology.edges_of(0)[0]).size(), 3u);
}

TEST(MeshTopology, EveryEdgeAndVertexHasOneOwnerAmongItsTriangles) {
  TriangleMesh mesh = make_torus(0.1, 0.03, 400);
  mesh.triangles.push_back({0, 0, 1});  // a degenerate triangle owns nothing
  const MeshTopology topology(mesh);
  for (const MeshTopology::Edge& edge : topology.edges()) {
    const Triangle& owner = mesh.triangles[static_cast<std::size_t>(edge.owner)];
    for (const std::int32_t v : edge.vertices)
      EXPECT_NE(std::find(owner.begin(), owner.end(), v), owner.end());
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices.size()); ++v) {
    const Triangle& owner = mesh.triangles[static_cast<std::size_t>(topology.owner_of(v))];
    EXPECT_NE(std::find(owner.begin(), owner.end(), v), owner.end());
  }
  EXPECT_EQ(topology.edges_of(static_cast<std::int32_t>(mesh.triangles.size()) - 1)[0], -1);
}

}  // namespace
}  // namespace glissade::collision

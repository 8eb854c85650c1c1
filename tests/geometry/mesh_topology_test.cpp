#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {
namespace {

std::int64_t count_edges(const MeshTopology& topology, bool flat) {
  return std::count_if(topology.edges().begin(), topology.edges().end(),
                       [&](const MeshTopology::Edge& edge) { return edge.flat == flat; });
}

std::vector<std::int32_t> stops(const MeshTopology& topology, const TriangleMesh& mesh) {
  std::vector<std::int32_t> vertices;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices.size()); ++v) {
    if (topology.can_stop(v)) vertices.push_back(v);
  }
  return vertices;
}

TEST(MeshTopology, OfABoxHasTwelveSharpEdgesAndSixFlatDiagonals) {
  const TriangleMesh box = make_box({0.1, 0.2, 0.3}, 12);
  const MeshTopology topology(box);
  EXPECT_EQ(count_edges(topology, false), 12);
  EXPECT_EQ(count_edges(topology, true), 6);
  EXPECT_EQ(stops(topology, box).size(), 8U);
}

TEST(MeshTopology, IsBlindToTheOrientationOfTriangles) {
  const TriangleMesh sphere = make_sphere(0.1, 500);
  const TriangleMesh flipped = flip_randomly(make_plate({1.0, 1.0}, 200), 5);
  EXPECT_EQ(count_edges(MeshTopology(flipped), true), count_edges(MeshTopology(make_plate({1.0, 1.0}, 200)), true));
  EXPECT_EQ(count_edges(MeshTopology(flip_randomly(sphere, 5)), false), count_edges(MeshTopology(sphere), false));
}

TEST(MeshTopology, OfASheetOnlyTheRimEdgesAndItsCornersCanStop) {
  const TriangleMesh sheet = make_plate({1.0, 1.0}, 200);  // 10 × 10 cells
  const MeshTopology topology(sheet);
  EXPECT_EQ(count_edges(topology, false), 40);
  const auto corners = stops(topology, sheet);
  EXPECT_EQ(corners.size(), 4U) << "the other vertices of the rim lie between two of them";
  for (const std::int32_t v : corners)
    EXPECT_EQ(sheet.vertices[static_cast<std::size_t>(v)].cwiseAbs().head<2>(), Eigen::Vector2d(0.5, 0.5));
}

TEST(MeshTopology, OfAFinelyCutBoxOnlyTheCornerVerticesCanStop) {
  const TriangleMesh box = flip_randomly(make_box({0.1, 0.2, 0.3}, 6000), 3);
  const MeshTopology topology(box);
  EXPECT_GT(count_edges(topology, false), 200);
  EXPECT_EQ(stops(topology, box).size(), 8U);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(box.triangles.size()); ++t) {
    const bool answers = std::any_of(topology.edges_of(t).begin(), topology.edges_of(t).end(), [&](std::int32_t e) {
      const MeshTopology::Edge& edge = topology.edges()[static_cast<std::size_t>(e)];
      return edge.owner == t && !edge.flat;
    });
    const auto& corners = box.triangles[static_cast<std::size_t>(t)];
    const bool has_corner = std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) {
      return topology.can_stop(v) && topology.owner_of(v) == t;
    });
    EXPECT_EQ(topology.owns_stopping_feature(t), answers || has_corner);
  }
}

TEST(MeshTopology, OfATubeOnlyVerticesOfTheEndsCanStop) {
  const TriangleMesh tube = make_tube(0.05, 0.4, 4000);
  const MeshTopology topology(tube);
  const auto vertices = stops(topology, tube);
  EXPECT_LT(4 * vertices.size(), tube.vertices.size());
  ASSERT_FALSE(vertices.empty());
  double lowest = tube.vertices[0].z();
  double highest = lowest;
  for (const Eigen::Vector3d& x : tube.vertices) {
    lowest = std::min(lowest, x.z());
    highest = std::max(highest, x.z());
  }
  for (const std::int32_t v : vertices) {
    const double z = tube.vertices[static_cast<std::size_t>(v)].z();
    EXPECT_TRUE(z == lowest || z == highest) << z;
  }
}

/// Two triangles in a row above a straight or bent rim, each half of a strip of its own.
TriangleMesh strip(double bend) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, bend, 0}, {0.5, 1, 0}, {1.5, 1, 0}};
  mesh.triangles = {{0, 1, 3}, {1, 2, 4}, {1, 4, 3}};
  return mesh;
}

// The vertex is half as far off the chord as the rim's other end is off the line.
TEST(MeshTopology, ARimIsStraightToATenthOfAMicrometre) {
  for (const double bend : {0.0, 1.8e-7, -1.8e-7})
    EXPECT_FALSE(MeshTopology(strip(bend)).can_stop(1)) << bend;
  for (const double bend : {2.2e-7, -2.2e-7, 4e-5, 0.5})
    EXPECT_TRUE(MeshTopology(strip(bend)).can_stop(1)) << bend;
}

TEST(MeshTopology, WhereARimTurnsBackOrForksItsVertexCanStop) {
  TriangleMesh spike;  // both edges at vertex 0 lead the same way
  spike.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1e-5}};
  spike.triangles = {{0, 1, 2}};
  EXPECT_TRUE(MeshTopology(spike).can_stop(0));
  TriangleMesh crossing = strip(0.0);  // another sheet hangs below the vertex inside the rim
  crossing.vertices.insert(crossing.vertices.end(), {{0.5, -1, 0}, {1.5, -1, 0}});
  crossing.triangles.push_back({1, 5, 6});
  EXPECT_TRUE(MeshTopology(crossing).can_stop(1));
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

TEST(MeshTopology, EdgesAreUniqueAndAscendingWithTheirApexes) {
  TriangleMesh mesh = make_torus(0.1, 0.03, 400);
  mesh.triangles.push_back({7, 7, 9});  // no edge of a degenerate triangle counts
  std::reverse(mesh.triangles.begin() + 5, mesh.triangles.begin() + 90);
  std::map<std::array<std::int32_t, 2>, std::vector<std::int32_t>> apexes;
  for (const Triangle& triangle : mesh.triangles) {
    if (triangle[0] == triangle[1]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [least, most] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      apexes[{least, most}].push_back(triangle[(i + 2) % 3]);
    }
  }
  const MeshTopology topology(mesh);
  ASSERT_EQ(topology.edges().size(), apexes.size());
  std::int32_t e = 0;
  for (const auto& [vertices, opposite] : apexes) {
    EXPECT_EQ(topology.edges()[static_cast<std::size_t>(e)].vertices, vertices);
    const auto found = topology.apexes_of(e++);
    EXPECT_EQ(std::vector<std::int32_t>(found.begin(), found.end()), opposite);
  }
}

/// A flat fan between an apex and a row of vertices.
TriangleMesh fan(const Eigen::Vector3d& apex, const std::vector<Eigen::Vector3d>& row) {
  TriangleMesh mesh;
  mesh.vertices = row;
  mesh.vertices.push_back(apex);
  const auto apex_number = static_cast<std::int32_t>(row.size());
  for (std::int32_t v = 0; v + 1 < apex_number; ++v)
    mesh.triangles.push_back({v, v + 1, apex_number});
  return mesh;
}

// Each vertex stands proud of its neighbors by a few nanometres only.
TEST(MeshTopology, StoppingVerticesKeepTheShapeOfAFinelyCutCurve) {
  constexpr double kRadius = 10.0;
  std::vector<Eigen::Vector3d> arc;
  for (int i = 0; i <= 200; ++i) {
    const double angle = 1e-4 * (i - 100) - 0.5 * std::numbers::pi;
    arc.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0);
  }
  const MeshTopology topology(fan(Eigen::Vector3d::Zero(), arc));
  std::size_t before = 0;
  int kept = 0;
  for (std::size_t i = 1; i < arc.size(); ++i) {
    if (i + 1 < arc.size() && !topology.can_stop(static_cast<std::int32_t>(i))) continue;
    ++kept;
    const Eigen::Vector3d chord = (arc[i] - arc[before]).normalized();
    for (std::size_t j = before; j < i; ++j) {
      const Eigen::Vector3d x = arc[j] - arc[before];
      EXPECT_LE((x - chord * chord.dot(x)).norm(), 1.01e-7);
    }
    before = i;
  }
  EXPECT_LT(kept, 120) << "some lie between";
}

// A closed rim of bends each of which is none by itself.
TEST(MeshTopology, ARingHasVerticesThatStop) {
  std::vector<Eigen::Vector3d> ring;
  constexpr int kCorners = 100'000;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
    ring.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  TriangleMesh mesh = fan(Eigen::Vector3d::Zero(), ring);
  for (Triangle& triangle : mesh.triangles) {
    for (std::int32_t& v : triangle)
      v = v == kCorners ? 0 : v;
  }
  const MeshTopology topology(mesh);
  int kept = 0;
  for (std::int32_t v = 0; v < kCorners; ++v)
    kept += topology.can_stop(v) ? 1 : 0;
  EXPECT_GT(kept, 1000);  // arcs of more than 0.9 mm would be 0.1 µm off their chord
}

}  // namespace
}  // namespace glissade::geometry

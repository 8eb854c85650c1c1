#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/geometry/triangle_pair.h>
#include <glissade/grasping/hand_model.h>

#include "enclosed_volume.h"
#include "random_chain.h"

namespace glissade::grasping {
namespace {

using Eigen::Vector3d;
using geometry::TriangleMesh;

std::vector<HandModel> some_hands() {
  std::vector<HandModel> hands;
  for (const hands::HandSide side : {hands::HandSide::kLeft, hands::HandSide::kRight})
    for (const double length_m : {0.12, 0.166, 0.183, 0.21})
      for (const double breadth : {0.38, 0.46, 0.52})
        hands.push_back(make_hand({.length_m = length_m, .breadth_m = breadth * length_m, .side = side}));
  return hands;
}

std::string name_of(const HandModel& hand, const ChainLink& link) {
  return link.name + " of a hand " + std::to_string(hand.shape.length_m) + " long, " +
         std::to_string(hand.shape.breadth_m) + " broad";
}

TEST(HandMeshes, AreClosedAndFaceOutward) {
  for (const HandModel& hand : some_hands()) {
    int meshes = 0;
    for (const ChainLink& link : hand.chain.links()) {
      if (!link.mesh) continue;
      ++meshes;
      const geometry::MeshReport report = geometry::report(*link.mesh);
      EXPECT_TRUE(report.is_watertight) << name_of(hand, link);
      EXPECT_EQ(report.inconsistent_edges + report.degenerate + report.duplicates, 0) << name_of(hand, link);
      EXPECT_EQ(report.components, 1) << name_of(hand, link);
      EXPECT_EQ(report.vertices - report.triangles / 2, 2) << name_of(hand, link) << ": a sphere by Euler's formula";
      EXPECT_EQ(geometry::weld(*link.mesh).vertices.size(), link.mesh->vertices.size()) << name_of(hand, link);
      EXPECT_GE(report.triangles, 150) << name_of(hand, link);
      EXPECT_LE(report.triangles, 400) << name_of(hand, link);
      EXPECT_GT(test_support::enclosed_volume(*link.mesh), 0.0) << name_of(hand, link);
    }
    EXPECT_EQ(meshes, 18);
  }
}

geometry::TrianglePoints points_of(const TriangleMesh& mesh, std::int32_t triangle) {
  return mesh.corners(triangle);
}

bool share_a_vertex(const geometry::Triangle& a, const geometry::Triangle& b) {
  return std::ranges::any_of(a, [&](std::int32_t vertex) { return std::ranges::find(b, vertex) != b.end(); });
}

TEST(HandMeshes, DoNotIntersectThemselves) {
  for (const HandModel& hand : some_hands()) {
    if (hand.shape.side == hands::HandSide::kLeft) continue;  // mirror images
    for (const ChainLink& link : hand.chain.links()) {
      if (!link.mesh) continue;
      const auto count = static_cast<std::int32_t>(link.mesh->triangles.size());
      int intersecting = 0;
      for (std::int32_t a = 0; a < count; ++a)
        for (std::int32_t b = a + 1; b < count; ++b)
          if (!share_a_vertex(link.mesh->triangles[static_cast<std::size_t>(a)],
                              link.mesh->triangles[static_cast<std::size_t>(b)]) &&
              geometry::triangles_intersect(points_of(*link.mesh, a), points_of(*link.mesh, b)))
            ++intersecting;
      EXPECT_EQ(intersecting, 0) << name_of(hand, link);
    }
  }
}

/// How far the mesh of a link extends along the bone.
Eigen::Vector2d extent_along_bone(const ChainLink& link) {
  Eigen::Vector2d extent(1.0, -1.0);
  for (const Vector3d& p_L : link.mesh->vertices)
    extent = {std::min(extent.x(), p_L.x()), std::max(extent.y(), p_L.x())};
  return extent;
}

// So that no gap opens between neighbors, however they turn.
TEST(HandMeshes, EncloseTheJointsAtBothEnds) {
  for (const HandModel& hand : some_hands()) {
    const std::span<const ChainLink> links = hand.chain.links();
    for (std::size_t i = 1; i < links.size(); ++i) {
      if (!links[i].mesh) continue;
      EXPECT_LT(extent_along_bone(links[i]).x(), 0.0) << name_of(hand, links[i]);
      for (std::size_t child = i + 1; child < links.size(); ++child) {
        if (links[child].parent != i) continue;
        EXPECT_GT(extent_along_bone(links[i]).y(), links[child].X_PJ.translation().x()) << name_of(hand, links[i]);
      }
    }
  }
}

// A typical man's hand displaces about 400 ml up to the wrist.
TEST(HandMeshes, HaveTheVolumeOfAHand) {
  const HandModel hand = make_hand();
  double volume = 0.0;
  for (const ChainLink& link : hand.chain.links())
    if (link.mesh) volume += test_support::enclosed_volume(*link.mesh);
  EXPECT_GT(volume, 300e-6);
  EXPECT_LT(volume, 600e-6) << "overlaps count twice";
}

}  // namespace
}  // namespace glissade::grasping

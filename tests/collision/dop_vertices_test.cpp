#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>

#include "kernels/instruction_set.h"
#include "kernels/node_kernels.h"
#include "kernels/vertex_alignment.h"
#include "random_numbers.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr unsigned kDopVerticesSeed = 7;
constexpr int kDirectionCounts[] = {6, 14, 18, 24, 26};

DopTree tree(const geometry::TriangleMesh& mesh, int k, Realignment realignment = Realignment::kBruteForce) {
  return DopTree(std::make_shared<const geometry::TriangleMesh>(mesh), {.directions = k, .realignment = realignment});
}

std::vector<Vector3d> vertices_of(const DopTree& tree, std::uint32_t node, std::size_t child) {
  std::vector<Vector3d> vertices;
  for (const VertexGroup& group : vertices_of(tree, node)) {
    for (std::size_t v = 0; v < 4; ++v) {
      const auto axis = [&](std::size_t a) { return static_cast<double>(group.coordinate[a][kWidth * v + child]); };
      vertices.emplace_back(axis(0), axis(1), axis(2));
    }
  }
  return vertices;
}

class Vertices : public ::testing::Test {
 protected:
  Vertices() { RecordProperty("seed", static_cast<int>(kDopVerticesSeed)); }

  Isometry3d random_pose(double translation) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = random_.rotation();
    X.translation() = translation * random_.point(1.0);
    return X;
  }

  test_support::RandomNumbers random_{kDopVerticesSeed};
};

TEST_F(Vertices, OfABoxOfThreeSlabsAreItsCorners) {
  const DopTree box = tree(geometry::make_box({2.0, 1.0, 0.5}, 100), 6);
  for (std::uint32_t node = 0; node < nodes_of(box).size(); ++node) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(nodes_of(box)[node].child_count()); ++c) {
      std::vector<Vector3d> corners;
      for (int i = 0; i < 8; ++i) {
        Vector3d corner;
        for (int axis = 0; axis < 3; ++axis) {
          const SlabRow& row = slabs_of(box, node)->rows[static_cast<std::size_t>(axis)];
          corner[axis] = (i >> axis & 1) != 0 ? row.above[c] : -row.below[c];
        }
        corners.push_back(corner);
      }
      ASSERT_EQ(vertices_of(box, node).size(), 2U);
      const std::vector<Vector3d> vertices = vertices_of(box, node, c);
      EXPECT_TRUE(std::is_permutation(vertices.begin(), vertices.end(), corners.begin()));
    }
  }
}

TEST_F(Vertices, LieWithinAllHalfSpacesAndOnThreePlanes) {
  for (const int k : kDirectionCounts) {
    const DopDirections& directions = dop_directions(k);
    const DopTree torus = tree(geometry::make_torus(0.7, 0.3, 500), k);
    for (std::uint32_t node = 0; node < nodes_of(torus).size(); ++node) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(nodes_of(torus)[node].child_count()); ++c) {
        for (const Vector3d& x : vertices_of(torus, node, c)) {
          int planes = 0;
          for (std::size_t i = 0; i < static_cast<std::size_t>(directions.slabs); ++i) {
            const SlabRow& row = slabs_of(torus, node)[i / 4].rows[i % 4];
            const double room_above = row.above[c] - directions.unit[i].dot(x);
            const double room_below = row.below[c] + directions.unit[i].dot(x);
            ASSERT_GE(std::min(room_above, room_below), -0.02) << "k " << k;  // a 64th of a step, and single precision
            planes += (room_above < 0.02 ? 1 : 0) + (room_below < 0.02 ? 1 : 0);
          }
          ASSERT_GE(planes, 3) << "k " << k;
        }
      }
    }
  }
}

// Nodes that are aligned already must stay what they are: planes that touch what they enclose keep their places.
TEST_F(Vertices, RealignmentByTheIdentityChangesNothing) {
  for (const int k : kDirectionCounts) {
    const DopTree torus = tree(geometry::make_torus(0.7, 0.3, 500), k);
    const VertexAlignment alignment(dop_directions(k), QueryFrame(torus, torus, Isometry3d::Identity()));
    for (std::uint32_t node = 0; node < nodes_of(torus).size(); ++node) {
      AlignedNode aligned;
      realign_vertices()(alignment, vertices_of(torus, node), aligned);
      for (std::size_t c = 0; c < static_cast<std::size_t>(nodes_of(torus)[node].child_count()); ++c) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(alignment.slabs); ++i) {
          const SlabRow& row = slabs_of(torus, node)[i / 4].rows[i % 4];
          ASSERT_NEAR(aligned.facing[8 * i + c], row.below[c], 3) << "k " << k;
          ASSERT_NEAR(aligned.facing[8 * i + 4 + c], row.above[c], 3) << "k " << k;
        }
      }
    }
  }
}

// The extreme of the vertices is the tightest bound there is; three weighted offsets are some bound.
TEST_F(Vertices, RealignNoLooserThanThreeOffsetsDo) {
  for (const int k : kDirectionCounts) {
    const DopTree sphere = tree(geometry::make_sphere(1.0, 500), k);
    const DopTree torus = tree(geometry::make_torus(0.6, 0.2, 500), k);
    std::int64_t excess = 0;
    for (int trial = 0; trial < 5; ++trial) {
      const QueryFrame frame(sphere, torus, random_pose(1.5));
      DopAlignment affine;
      align(k, frame, affine);
      const VertexAlignment brute_force(dop_directions(k), frame);
      for (std::uint32_t node = 0; node < nodes_of(torus).size(); ++node) {
        AlignedNode by_offsets;
        AlignedNode by_vertices;
        node_kernels().realign(affine, slabs_of(torus, node), by_offsets);
        realign_vertices()(brute_force, vertices_of(torus, node), by_vertices);
        for (std::size_t lane = 0; lane < 8 * static_cast<std::size_t>(affine.slabs); ++lane) {
          if (lane % 4 >= static_cast<std::size_t>(nodes_of(torus)[node].child_count())) continue;
          // Both are rounded up to whole steps, from bounds that are padded for rounding.
          ASSERT_LE(by_vertices.facing[lane], by_offsets.facing[lane] + 1) << "k " << k;
          excess += by_offsets.facing[lane] - by_vertices.facing[lane];
        }
      }
    }
    EXPECT_GT(excess, 0) << "k " << k;
  }
}

TEST_F(Vertices, QueriesAnswerAsWithThreeOffsets) {
  const geometry::TriangleMesh bodies[] = {geometry::make_sphere(1.0, 300), geometry::make_torus(0.7, 0.3, 400),
                                           geometry::make_hyperboloid(0.2, 0.5, 1.5, 300)};
  QueryWorkspace workspace;
  std::vector<TrianglePair> expected;
  std::vector<TrianglePair> actual;
  std::size_t found = 0;
  for (const int k : kDirectionCounts) {
    for (std::size_t i = 0; i < 3; ++i) {
      const geometry::TriangleMesh& mesh_A = bodies[i];
      const geometry::TriangleMesh& mesh_B = bodies[(i + 1) % 3];
      const DopTree affine_A = tree(mesh_A, k, Realignment::kAffine);
      const DopTree affine_B = tree(mesh_B, k, Realignment::kAffine);
      const DopTree vertices_A = tree(mesh_A, k);
      const DopTree vertices_B = tree(mesh_B, k);
      for (int trial = 0; trial < 20; ++trial) {
        const Isometry3d X_AB = random_pose(1.2);
        for (const double tolerance : {0.0, 0.01}) {
          intersecting_pairs(affine_A, affine_B, X_AB, workspace, expected, tolerance);
          intersecting_pairs(vertices_A, vertices_B, X_AB, workspace, actual, tolerance);
          ASSERT_EQ(actual, expected) << "k " << k;
          ASSERT_EQ(intersects(vertices_A, vertices_B, X_AB, workspace, tolerance), !expected.empty());
          found += expected.size();
        }
      }
    }
  }
  EXPECT_GT(found, 0U);
}

TEST_F(Vertices, FollowTheMeshWhenTheTreeIsFittedAnew) {
  const geometry::TriangleMesh torus = geometry::make_torus(0.7, 0.3, 300);
  geometry::TriangleMesh stretched = torus;
  for (Vector3d& vertex : stretched.vertices)
    vertex.z() *= 3.0;
  const auto mesh = std::make_shared<geometry::TriangleMesh>(torus);
  DopTree refitted(mesh, {.realignment = Realignment::kBruteForce});
  mesh->vertices = stretched.vertices;
  refitted.refit();

  const DopTree affine = tree(stretched, 24, Realignment::kAffine);
  const DopTree sphere_affine = tree(geometry::make_sphere(0.5, 200), 24, Realignment::kAffine);
  const DopTree sphere = tree(geometry::make_sphere(0.5, 200), 24);
  QueryWorkspace workspace;
  std::vector<TrianglePair> expected;
  std::vector<TrianglePair> actual;
  for (int trial = 0; trial < 20; ++trial) {
    const Isometry3d X_AB = random_pose(1.0);
    intersecting_pairs(affine, sphere_affine, X_AB, workspace, expected);
    intersecting_pairs(refitted, sphere, X_AB, workspace, actual);
    EXPECT_EQ(actual, expected);
  }
}

}  // namespace
}  // namespace glissade::collision

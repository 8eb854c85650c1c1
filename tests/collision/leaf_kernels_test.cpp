#include "kernels/leaf_kernels.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/reference/brute_force.h>

#include "kernel_fixture.h"
#include "query/placed_trees.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Every leaf of one tree with every leaf of another, somewhere.
class LeafKernelsTest : public Kernels {
 protected:
  struct Visit {
    const LeafFrame& frame;
    LeafPair& leaves;                        ///< prepared
    const std::array<double, 16>& distance;  ///< of each pair, in radii of the base; negative where there is none
    double rounding;                         ///< of the distances
  };

  // check(Visit)
  template <typename Check>
  void for_all_leaves(const Setting& s, const Check& check) {
    const DopTree tree_A = tree(soup(40), s.scale_A, s.scale_A * s.offset * random_vector());
    const DopTree tree_B = tree(soup(40), s.scale_B, s.scale_B * random_vector());
    const Isometry3d X_AB = random_pose(tree_A, tree_B, s.translation * s.scale_A);
    const PlacedTrees placed{tree_A, tree_B, X_AB};
    const double radius = placed.frame.base_radius;
    const double rounding = 1e-12 * (tree_A.center().norm() + X_AB.translation().norm()) / radius;
    const LeafFrame frame(placed.frame);
    for (std::uint32_t leaf_M = 0; leaf_M < leaves_of(placed.base()).size(); ++leaf_M) {
      for (std::uint32_t leaf_N = 0; leaf_N < leaves_of(placed.other()).size(); ++leaf_N) {
        std::array<double, 16> distance;
        for (int pair = 0; pair < 16; ++pair) {
          const TrianglePair triangles = placed.triangles(leaf_M, leaf_N, pair);
          const bool exists = triangles.triangle_A >= 0 && triangles.triangle_B >= 0;
          distance[static_cast<std::size_t>(pair)] =
              exists ? geometry::triangle_distance(placed.points_A(triangles), placed.points_B(triangles)).distance /
                           radius
                     : -1.0;
        }
        LeafPair leaves;
        leaf_kernels().prepare_M(leaves_of(placed.base())[leaf_M], leaves);
        leaf_kernels().prepare_N(frame, leaves_of(placed.other())[leaf_N], leaves);
        check(Visit{frame, leaves, distance, rounding});
      }
    }
  }
};

bool has(PairMask pairs, std::size_t pair) {
  return (pairs >> pair & 1U) != 0;
}

TEST_P(LeafKernelsTest, GapsByNormalsAndEdgesNeverExceedTheDistance) {
  for (const Setting& s : kSettings) {
    int by_normals = 0;
    int by_edges = 0;
    for (const double tolerance : {0.0, 0.01, 0.3}) {
      for_all_leaves(s, [&](const Visit& visit) {
        const auto limit = static_cast<float>(tolerance);
        const PairMask near = leaf_kernels().test(visit.frame, limit, visit.leaves);
        const TriangleGaps along_normals = visit.leaves.gaps;
        const PairMask nearer = leaf_kernels().edges(visit.frame, limit, near, visit.leaves);
        ASSERT_EQ(nearer & ~near, 0U);
        for (std::size_t pair = 0; pair < 16; ++pair) {
          if (visit.distance[pair] < 0.0) {
            ASSERT_FALSE(has(near, pair));
            continue;
          }
          const double at_most = visit.distance[pair] + visit.rounding;
          ASSERT_LE(static_cast<double>(visit.leaves.gaps.gap[pair]), at_most);
          ASSERT_GE(visit.leaves.gaps.gap[pair], along_normals.gap[pair]);
          if (!has(nearer, pair)) {
            ASSERT_GT(at_most, tolerance);
          }
          by_normals += has(near, pair) ? 0 : 1;
          by_edges += has(near & ~nearer, pair) ? 1 : 0;
        }
      });
    }
    EXPECT_GT(by_normals, 0);
    // Far from a small object nothing is certain.
    if (s.offset < 1e3) {
      EXPECT_GT(by_edges, 0);
    }
  }
}

/// How far a direction holds two triangles apart, all in the frame of the base.
double gap_along(const Vector3d& n, const LeafTriangles& p, std::size_t of_p, const LeafTriangles& q,
                 std::size_t of_q) {
  const auto height = [&](const LeafTriangles& leaf, std::size_t triangle, std::size_t c) {
    return n.dot(Eigen::Vector3f(leaf.corner[0][c][triangle], leaf.corner[1][c][triangle], leaf.corner[2][c][triangle])
                     .cast<double>());
  };
  return std::min({height(q, of_q, 0), height(q, of_q, 1), height(q, of_q, 2)}) -
         std::max({height(p, of_p, 0), height(p, of_p, 1), height(p, of_p, 2)});
}

TEST_P(LeafKernelsTest, DirectionsSeparateTrianglesByTheirGaps) {
  int by_normals_of_M = 0;
  int by_normals_of_N = 0;
  int by_edges = 0;
  for (const Setting& s : kSettings) {
    for_all_leaves(s, [&](const Visit& visit) {
      constexpr float kFar = 0.3F;
      const PairMask near = leaf_kernels().test(visit.frame, kFar, visit.leaves);
      const TriangleGaps along_normals = visit.leaves.gaps;
      const PairMask nearer = leaf_kernels().edges(visit.frame, kFar, near, visit.leaves);
      const TriangleGaps expected = visit.leaves.gaps;
      visit.leaves.gaps = along_normals;
      ASSERT_EQ(leaf_kernels().edges_and_directions(visit.frame, kFar, near, visit.leaves), nearer);
      ASSERT_EQ(visit.leaves.gaps.gap, expected.gap);
      for (std::size_t pair = 0; pair < 16; ++pair) {
        const auto gap = static_cast<double>(expected.gap[pair]);
        if (!has(nearer, pair) || !(gap > 0.0)) continue;
        const auto& components = visit.leaves.directions.n;
        const Vector3d n =
            Eigen::Vector3f(components[0][pair], components[1][pair], components[2][pair]).cast<double>().normalized();
        const LeafTriangles& p = visit.leaves.p;
        const LeafTriangles& q = visit.leaves.q;
        ASSERT_GE(gap_along(n, p, pair / kWidth, q, pair % kWidth), gap) << "from M to N";
        ASSERT_EQ(has(visit.leaves.by_edges, pair), gap > static_cast<double>(along_normals.gap[pair]));
        if (has(visit.leaves.by_edges, pair)) {
          ++by_edges;
          continue;
        }
        const bool by_N = has(visit.leaves.by_N, pair);
        const LeafTriangles& own = by_N ? q : p;
        const std::size_t triangle = by_N ? pair % kWidth : pair / kWidth;
        const Eigen::Vector3f normal(own.normal[0][triangle], own.normal[1][triangle], own.normal[2][triangle]);
        ASSERT_GT(std::abs(n.dot(normal.cast<double>().normalized())), 1.0 - 1e-6);
        ++(by_N ? by_normals_of_N : by_normals_of_M);
      }
    });
  }
  EXPECT_GT(by_normals_of_M, 20);
  EXPECT_GT(by_normals_of_N, 20);
  EXPECT_GT(by_edges, 20);
}

// All normals and cross products of edges are perpendicular to the plane, where there is no gap.
TEST_P(LeafKernelsTest, TrianglesBesideEachOtherInOnePlaneAreSeparatedByTheirDistance) {
  const geometry::TriangleMesh below{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.3, -1.0, 0.0}}, {{0, 1, 2}}};
  const geometry::TriangleMesh above{{{0.2, 0.0, 0.0}, {0.9, 0.0, 0.0}, {0.6, 1.0, 0.0}}, {{0, 1, 2}}};
  for (const double gap : {0.01, 0.1, 1.0}) {
    const DopTree tree_A = tree(below, 1.0, Vector3d::Zero());
    const DopTree tree_B = tree(above, 1.0, {0.0, gap, 0.0});
    const Isometry3d X_AB = Isometry3d::Identity();
    const PlacedTrees placed{tree_A, tree_B, X_AB};
    const LeafFrame frame(placed.frame);
    LeafPair leaves;
    leaf_kernels().prepare_M(leaves_of(placed.base())[0], leaves);
    leaf_kernels().prepare_N(frame, leaves_of(placed.other())[0], leaves);
    const auto radii = static_cast<float>(gap / placed.frame.base_radius);
    ASSERT_TRUE(has(leaf_kernels().test(frame, 0.99F * radii, leaves), 0));
    EXPECT_FALSE(has(leaf_kernels().edges(frame, 0.99F * radii, 1U, leaves), 0)) << "gap " << gap;
    EXPECT_NEAR(leaves.gaps.gap[0], radii, 1e-5) << "gap " << gap;
  }
}

TEST_P(LeafKernelsTest, NoTwoTrianglesAreNearerThanTheirLeaves) {
  int separated = 0;
  for (const Setting& s : kSettings) {
    for_all_leaves(s, [&](const Visit& visit) {
      double least = 1e30;
      for (const double distance : visit.distance) {
        if (distance >= 0.0) least = std::min(least, distance);
      }
      const auto gap = static_cast<double>(leaf_kernels().leaf_gap(visit.frame, visit.leaves));
      ASSERT_LE(gap, least + visit.rounding);
      separated += gap > 0.0 ? 1 : 0;
    });
  }
  EXPECT_GT(separated, 50);
}

TEST_P(LeafKernelsTest, CertaintiesAboutTrianglesAreTrue) {
  for (const Setting& s : kSettings) {
    int certain_pairs = 0;
    for (int trial = 0; trial < 5; ++trial) {
      for_all_leaves(s, [&](const Visit& visit) {
        const PairMask near = leaf_kernels().test(visit.frame, 0.0F, visit.leaves);
        const CertainPairs certain = leaf_kernels().cross(visit.frame, visit.leaves);
        for (std::size_t pair = 0; pair < 16; ++pair) {
          if (!has(near, pair)) continue;
          if (has(certain.intersect, pair)) {
            ASSERT_EQ(visit.distance[pair], 0.0);
          }
          if (has(certain.apart, pair)) {
            ASSERT_GT(visit.distance[pair], 0.0);
          }
          certain_pairs += has(certain.intersect | certain.apart, pair) ? 1 : 0;
        }
      });
    }
    if (s.offset < 1e3 && s.scale_A == s.scale_B) {
      EXPECT_GT(certain_pairs, 15);
    }
  }
}

// Two triangles, moved to where they just meet or just do not: there single precision must not be too sure.
TEST_P(LeafKernelsTest, CertaintiesHoldWhereTrianglesBarelyMeet) {
  int certain_pairs = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const auto triangle = [&] {
      const geometry::TriangleMesh mesh{{random_vector(), random_vector(), random_vector()}, {{0, 1, 2}}};
      return tree(mesh, trial % 2 == 0 ? 1.0 : 0.3, Vector3d::Zero());
    };
    const DopTree tree_A = triangle();
    const DopTree tree_B = triangle();
    Isometry3d X_AB = random_pose(tree_A, tree_B, 0.1);
    const Vector3d start = X_AB.translation();
    const Vector3d way = 4.0 * random_.direction();
    const auto meet = [&](double along) {
      X_AB.translation() = start + along * way;
      return reference::brute_force_intersects(tree_A.mesh(), tree_B.mesh(), X_AB);
    };
    if (!meet(0.0)) continue;
    double meeting = 0.0;
    double apart = 1.0;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (meeting + apart);
      (meet(middle) ? meeting : apart) = middle;
    }
    const double off = random_.power_of_ten(-10.0, -4.0);
    const bool intersect = meet(random_.chance(0.5) ? meeting - off : apart + off);
    const PlacedTrees placed{tree_A, tree_B, X_AB};
    const LeafFrame frame(placed.frame);
    LeafPair leaves;
    leaf_kernels().prepare_M(leaves_of(placed.base())[0], leaves);
    leaf_kernels().prepare_N(frame, leaves_of(placed.other())[0], leaves);
    ASSERT_TRUE(!intersect || has(leaf_kernels().test(frame, 0.0F, leaves), 0)) << "trial " << trial;
    const CertainPairs certain = leaf_kernels().cross(frame, leaves);
    ASSERT_FALSE(has(intersect ? certain.apart : certain.intersect, 0)) << "trial " << trial << ", off " << off;
    certain_pairs += has(certain.apart | certain.intersect, 0) ? 1 : 0;
  }
  EXPECT_GT(certain_pairs, 50);
}

TEST_P(LeafKernelsTest, TheLeastGapIsOfThePairsAskedFor) {
  LeafPair leaves;
  for (int trial = 0; trial < 200; ++trial) {
    for (float& gap : leaves.gaps.gap)
      gap = static_cast<float>(random_.uniform(-1.0, 1.0));
    const auto pairs = static_cast<PairMask>(random_.integer(0, 0xffff));
    float least = 1e30F;
    for (std::size_t pair = 0; pair < 16; ++pair) {
      if (has(pairs, pair)) least = std::min(least, leaves.gaps.gap[pair]);
    }
    EXPECT_EQ(leaf_kernels().least_gap(leaves, pairs), least);
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, LeafKernelsTest, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace glissade::collision

#include "kernels/node_kernels.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "kernel_fixture.h"
#include "kernels/vertex_alignment.h"
#include "query/placed_trees.h"
#include "sanitizers.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Triangles below child c of a node.
void collect(const DopTree& tree, const NodeHead& head, int c, std::vector<std::int32_t>& triangles) {
  if (head.is_leaf(c)) {
    for (const std::int32_t t : leaves_of(tree)[head.child(c)].triangle) {
      if (t != kNoTriangle) triangles.push_back(t);
    }
    return;
  }
  const NodeHead& child = nodes_of(tree)[head.child(c)];
  for (int grandchild = 0; grandchild < child.child_count(); ++grandchild)
    collect(tree, child, grandchild, triangles);
}

void expect_inside(const AlignedNode& aligned, const DopDirections& directions, int c, const Vector3d& x) {
  for (int i = 0; i < directions.slabs; ++i) {
    const double height = directions.half_space(i).dot(x);
    const auto lane = static_cast<std::size_t>(8 * i + c);
    const double below = aligned.facing[lane];
    const double above = aligned.facing[lane + 4];
    // What saturates lies beyond the whole grid of the base, where nothing is to be enclosed.
    if (above < 32767.0 && height < kGridRadius) {
      ASSERT_LE(height, above);
    }
    if (below < 32767.0 && height > -kGridRadius) {
      ASSERT_LE(-height, below);
    }
  }
}

TEST_P(Kernels, RealignedNodesEncloseEveryTransformedPoint) {
  for (const int k : {6, 14, 18, 24, 26}) {
    const DopDirections& directions = dop_directions(k);
    for (const Setting& s : kSettings) {
      const DopTreeOptions options{.directions = k, .realignment = Realignment::kBruteForce};  // for the vertices, too
      const DopTree tree_A = tree(soup(40), s.scale_A, s.scale_A * s.offset * random_vector(), options);
      const DopTree tree_B = tree(soup(40), s.scale_B, s.scale_B * random_vector(), options);
      for (int trial = 0; trial < 10; ++trial) {
        const Isometry3d X_AB = random_pose(tree_A, tree_B, s.translation * s.scale_A);
        const PlacedTrees placed{tree_A, tree_B, X_AB};
        const QueryFrame& frame = placed.frame;
        const DopTree& base = placed.base();
        const DopTree& other = placed.other();
        const Isometry3d X_MN = frame.base_is_A ? X_AB : X_AB.inverse();
        DopAlignment alignment;
        align(k, frame, alignment);
        for (std::uint32_t node = 0; node < nodes_of(other).size(); ++node) {
          AlignedNode aligned[2];
          node_kernels().realign(alignment, slabs_of(other, node), aligned[0]);
          realign_vertices()(VertexAlignment(directions, frame), vertices_of(other, node), aligned[1]);
          for (int c = 0; c < nodes_of(other)[node].child_count(); ++c) {
            std::vector<std::int32_t> triangles;
            collect(other, nodes_of(other)[node], c, triangles);
            for (const std::int32_t t : triangles) {
              for (int corner = 0; corner < 3; ++corner) {
                const Vector3d x =
                    (X_MN * other.mesh().corner(t, corner) - base.center()) * (kGridRadius / base.radius());
                ASSERT_NO_FATAL_FAILURE(expect_inside(aligned[0], directions, c, x)) << "affine, k " << k;
                ASSERT_NO_FATAL_FAILURE(expect_inside(aligned[1], directions, c, x)) << "brute force, k " << k;
              }
            }
          }
        }
      }
    }
  }
}

TEST_P(Kernels, OverlapsOfPairsBoundTheirDistance) {
  for (const bool with_thin_slabs : {false, true}) {
    for (const Setting& s : kSettings) {
      // Curved surfaces, whose nodes are thin.
      const DopTree tree_A = tree(geometry::make_sphere(1.0, 200), s.scale_A, s.scale_A * s.offset * random_vector());
      const DopTree tree_B = tree(geometry::make_torus(0.7, 0.3, 200), s.scale_B, s.scale_B * random_vector());
      int separated = 0;
      for (int trial = 0; trial < 3; ++trial) {
        const Isometry3d X_AB = random_pose(tree_A, tree_B, s.translation * s.scale_A);
        const PlacedTrees placed{tree_A, tree_B, X_AB};
        const QueryFrame& frame = placed.frame;
        const DopTree& base = placed.base();
        const DopTree& other = placed.other();
        const Isometry3d X_MN = frame.base_is_A ? X_AB : X_AB.inverse();
        DopAlignment alignment;
        align(24, frame, alignment);
        for (std::uint32_t p = 0; p < nodes_of(base).size(); p += test_support::kSanitized ? 30 : 3) {
          for (std::uint32_t q = 0; q < nodes_of(other).size(); q += 5) {
            AlignedNode aligned;
            PairOverlaps overlaps;
            const NodeHead& head_M = nodes_of(base)[p];
            const NodeHead& head_N = nodes_of(other)[q];
            node_kernels().realign(alignment, slabs_of(other, q), aligned);
            PairMask near = node_kernels().test(slabs_of(base, p), aligned, 12, 0, overlaps);
            if (with_thin_slabs) {
              near = node_kernels().test_thin(ThinSlabFrame(frame), head_M, slabs_of(base, p), head_N,
                                              slabs_of(other, q), 0, overlaps);
            }
            for (int i = 0; i < head_M.child_count(); ++i) {
              for (int j = 0; j < head_N.child_count(); ++j) {
                const auto pair = static_cast<std::size_t>(kWidth * i + j);
                ASSERT_EQ((near >> pair & 1U) != 0, overlaps.overlap[pair] >= 0);
                if (overlaps.overlap[pair] >= 0) continue;
                ++separated;
                std::vector<std::int32_t> triangles_M;
                std::vector<std::int32_t> triangles_N;
                collect(base, head_M, i, triangles_M);
                collect(other, head_N, j, triangles_N);
                const double distance = least_distance(base, triangles_M, other, triangles_N, X_MN);
                const double rounding = 1e-12 * (base.center().norm() + X_MN.translation().norm());
                ASSERT_LE(-overlaps.overlap[pair] * base.radius() / kGridRadius, distance + rounding);
              }
            }
          }
        }
      }
      EXPECT_GT(separated, 0);
    }
  }
}

TEST_P(Kernels, TestFindsTheLeastOverlapOfEverySlab) {
  for (int trial = 0; trial < 200; ++trial) {
    alignas(64) std::array<SlabLine, 4> node;
    AlignedNode aligned;
    for (SlabLine& line : node) {
      for (SlabRow& row : line.rows) {
        for (std::size_t c = 0; c < 4; ++c) {
          row.above[c] = static_cast<std::int16_t>(random_.integer(-20000, 20000));
          row.below[c] = static_cast<std::int16_t>(random_.integer(-20000, 20000));
        }
      }
    }
    for (std::int16_t& value : aligned.facing)
      value = static_cast<std::int16_t>(random_.integer(-20000, 20000));
    for (const int slabs : {4, 8, 12, 16}) {
      PairOverlaps overlaps;
      const PairMask near = node_kernels().test(node.data(), aligned, slabs, -9000, overlaps);
      for (std::size_t p = 0; p < 4; ++p) {
        for (std::size_t q = 0; q < 4; ++q) {
          int least = 32767;
          for (std::size_t i = 0; i < static_cast<std::size_t>(slabs); ++i) {
            const SlabRow& row = node[i / 4].rows[i % 4];
            least = std::min(
                {least, row.above[p] + aligned.facing[8 * i + q], row.below[p] + aligned.facing[8 * i + 4 + q]});
          }
          least = std::max(least, -32768);
          EXPECT_EQ(overlaps.overlap[4 * p + q], least);
          EXPECT_EQ((near >> (4 * p + q) & 1U) != 0, least >= -9000);
        }
      }
    }
  }
}

TEST_P(Kernels, DeepestPairIsWithinSixteenStepsOfTheMaximum) {
  for (int trial = 0; trial < 200; ++trial) {
    PairOverlaps overlaps;
    for (std::int16_t& overlap : overlaps.overlap)
      overlap = static_cast<std::int16_t>(random_.integer(-30000, 30000));
    const auto pairs = static_cast<PairMask>(random_.integer(1, 0xffff));
    int most = -32768;
    for (std::size_t pair = 0; pair < 16; ++pair) {
      if ((pairs >> pair & 1U) != 0) most = std::max<int>(most, overlaps.overlap[pair]);
    }
    EXPECT_EQ(node_kernels().most_overlap(overlaps, pairs), most);
    const int deepest = node_kernels().deepest(overlaps, pairs);
    ASSERT_NE(pairs >> deepest & 1U, 0U);
    EXPECT_GT(overlaps.overlap[static_cast<std::size_t>(deepest)], most - 16);
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, Kernels, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace glissade::collision

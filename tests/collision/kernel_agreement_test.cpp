// Every instruction set computes the same bits: gaps, overlaps and decisions. What a query visits, and so the work that
// it counts, depends on nothing else.

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "kernel_fixture.h"
#include "kernels/distance_bounds.h"
#include "kernels/leaf_kernels.h"
#include "kernels/node_kernels.h"
#include "query/placed_trees.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Bits = std::vector<std::uint32_t>;

void add(float value, Bits& bits) {
  bits.push_back(std::bit_cast<std::uint32_t>(value));
}

void add_nodes(const PlacedTrees& placed, Bits& bits) {
  DopAlignment alignment;
  align(24, placed.frame, alignment);
  const ThinSlabFrame thin(placed.frame);
  for (std::uint32_t p = 0; p < nodes_of(placed.base()).size(); p += 7) {
    for (std::uint32_t q = 0; q < nodes_of(placed.other()).size(); q += 5) {
      const NodeHead& head_M = nodes_of(placed.base())[p];
      const NodeHead& head_N = nodes_of(placed.other())[q];
      const SlabLine* slabs_M = slabs_of(placed.base(), p);
      const SlabLine* slabs_N = slabs_of(placed.other(), q);
      PairOverlaps overlaps;
      bits.push_back(node_kernels().realign_and_test(alignment, slabs_M, slabs_N, -100, overlaps));
      const PairMask both_thin = rows_of(head_M.thin) & columns_of(head_N.thin);
      bits.push_back(both_thin & node_kernels().test_thin(thin, head_M, slabs_M, head_N, slabs_N, -100, overlaps));
      for (std::size_t pair = 0; pair < overlaps.overlap.size(); ++pair) {
        if ((both_thin >> pair & 1U) != 0) bits.push_back(static_cast<std::uint16_t>(overlaps.overlap[pair]));
      }
    }
  }
}

/// The bounds of what the nodes have, along some axes.
void add_distance_bounds(const PlacedTrees& placed, Bits& bits) {
  const Eigen::Matrix3d axes = Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized().toRotationMatrix();
  std::array<BoxFrame, kBoxFrames> frames;
  frames.fill(box_frame(24, placed.frame, axes, 0.1));
  const int slabs = dop_directions(24).slabs;
  for (std::uint32_t p = 0; p < nodes_of(placed.base()).size(); p += 7) {
    for (std::uint32_t q = 0; q < nodes_of(placed.other()).size(); q += 5) {
      const NodeHead& head_M = nodes_of(placed.base())[p];
      const NodeHead& head_N = nodes_of(placed.other())[q];
      DistanceBounds all;
      DistanceBounds along;
      bound_distances(frames, {head_M, slabs_of(placed.base(), p)}, {head_N, slabs_of(placed.other(), q)}, slabs, all);
      bound_along(frames[0], {head_M, slabs_of(placed.base(), p)}, {head_N, slabs_of(placed.other(), q)}, slabs, along);
      for (int i = 0; i < head_M.child_count(); ++i) {
        for (int j = 0; j < head_N.child_count(); ++j) {
          const auto pair = static_cast<std::size_t>(kWidth * i + j);
          add(all.bound[pair], bits);
          add(along.bound[pair], bits);
        }
      }
    }
  }
}

/// `edges` looks at some pairs only, as after a test of nodes.
void add_leaves(const PlacedTrees& placed, Bits& bits) {
  const LeafFrame frame(placed.frame);
  LeafPair leaves;
  for (std::uint32_t p = 0; p < leaves_of(placed.base()).size(); p += 3) {
    leaf_kernels().prepare_M(leaves_of(placed.base())[p], leaves);
    for (std::uint32_t q = 0; q < leaves_of(placed.other()).size(); q += 3) {
      leaf_kernels().prepare_N(frame, leaves_of(placed.other())[q], leaves);
      add(leaf_kernels().leaf_gap(frame, leaves), bits);
      const PairMask near = leaf_kernels().test(frame, 0.05F, leaves);
      const CertainPairs certain = leaf_kernels().cross(frame, leaves);
      const PairMask nearer = leaf_kernels().edges(frame, 0.05F, near & 0x2b5d, leaves);
      const PairMask with_directions = leaf_kernels().edges_and_directions(frame, 0.05F, near & 0x6a3c, leaves);
      bits.insert(bits.end(), {with_directions, leaves.by_edges & with_directions, leaves.by_N & near});
      for (PairMask rest = with_directions; rest != 0; rest &= rest - 1) {
        for (const auto& components : leaves.directions.n)
          add(components[static_cast<std::size_t>(std::countr_zero(rest))], bits);
      }
      leaf_kernels().along(frame, {0.6F, 0.0F, -0.8F}, leaves);
      bits.insert(bits.end(), {near, certain.apart, certain.intersect, nearer});
      add(leaf_kernels().least_gap(leaves, near), bits);
      for (std::size_t pair = 0; pair < leaves.gaps.gap.size(); ++pair) {
        if ((leaves.present() >> pair & 1U) != 0) add(leaves.gaps.gap[pair], bits);
      }
    }
  }
}

class KernelAgreement : public Kernels {};

TEST_P(KernelAgreement, EveryInstructionSetComputesTheSameBits) {
  for (const Setting& s : kSettings) {
    for (int trial = 0; trial < 4; ++trial) {
      const bool is_curved = trial % 2 == 0;
      const DopTree tree_A = tree(is_curved ? geometry::make_sphere(1.0, 300) : soup(100), s.scale_A,
                                  s.scale_A * s.offset * random_vector());
      const DopTree tree_B =
          tree(is_curved ? geometry::make_torus(0.7, 0.3, 300) : soup(100), s.scale_B, s.scale_B * random_vector());
      const Isometry3d X_AB = random_pose(tree_A, tree_B, s.translation * s.scale_A);
      const auto computed_by = [&](InstructionSet instruction_set) {
        use_instruction_set(instruction_set);
        const PlacedTrees placed{tree_A, tree_B, X_AB};
        Bits bits;
        add_nodes(placed, bits);
        add_distance_bounds(placed, bits);
        add_leaves(placed, bits);
        return bits;
      };
      const Bits expected = computed_by(available_instruction_sets().front());
      const Bits bits = computed_by(GetParam());
      ASSERT_EQ(bits.size(), expected.size());
      EXPECT_TRUE(bits == expected) << "trial " << trial << ", scales " << s.scale_A << " and " << s.scale_B;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, KernelAgreement, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace glissade::collision

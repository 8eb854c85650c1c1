#pragma once

/// The vector code of node visits: four children of one tree against four of the other.

#include <array>
#include <cstdint>

#include "kernels/child_pairs.h"
#include "kernels/dop_alignment.h"
#include "kernels/thin_slab.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// A node of N in the frame of M. Each row holds the bounds that face `above` and those that face `below` of the same
/// row of M, so that a sum of lanes is an overlap.
struct alignas(64) AlignedNode {
  std::array<std::int16_t, 8 * kMostRows> facing;
};

struct NodeKernels {
  /// Realigns the four children of a node of N. O(k).
  void (*realign)(const DopAlignment& alignment, const SlabLine* node_N, AlignedNode& aligned);

  /// Tests 16 pairs and sets their overlaps. Returns the pairs that overlap by at least `least_overlap`, which must be
  /// at least −32767.
  PairMask (*test)(const SlabLine* node_M, const AlignedNode& aligned, int slabs, int least_overlap,
                   PairOverlaps& overlaps);

  /// `realign` and `test` in one step.
  PairMask (*realign_and_test)(const DopAlignment& alignment, const SlabLine* node_M, const SlabLine* node_N,
                               int least_overlap, PairOverlaps& overlaps);

  /// Tests the thin slabs of 16 pairs. Lowers overlaps, and returns a mask as `test` does.
  PairMask (*test_thin)(const ThinSlabFrame& frame, const NodeHead& head_M, const SlabLine* node_M,
                        const NodeHead& head_N, const SlabLine* node_N, int least_overlap, PairOverlaps& overlaps);

  /// The greatest overlap of the pairs in the mask, which must not be 0.
  int (*most_overlap)(const PairOverlaps& overlaps, PairMask pairs);

  /// A pair in the mask, which must not be 0, whose overlap is the greatest to within 16 grid steps.
  int (*deepest)(const PairOverlaps& overlaps, PairMask pairs);
};

/// The kernels of the instruction set in use.
const NodeKernels& node_kernels();

}  // namespace glissade::collision

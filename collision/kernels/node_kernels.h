#pragma once

/// The vector code of node visits: four children of one tree against four of the other.

#include <array>
#include <cstdint>

#include "kernels/child_pairs.h"
#include "kernels/dop_alignment.h"
#include "kernels/thin_slab.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// Node of N in the frame of M. Each row holds what faces `above` and what faces `below` of the rows of M, so that a
/// sum of lanes is an overlap.
struct alignas(64) AlignedNode {
  std::array<std::int16_t, 8 * kMostRows> facing;
};

struct NodeKernels {
  /// Realigns the four children of a node of N. O(k).
  void (*realign)(const DopAlignment& alignment, const SlabLine* node_N, AlignedNode& aligned);

  /// Tests 16 pairs; the mask has those that overlap by at least `least_overlap` ≥ −32767.
  PairMask (*test)(const SlabLine* node_M, const AlignedNode& aligned, int slabs, int least_overlap,
                   PairOverlaps& overlaps);

  /// Both in one.
  PairMask (*realign_and_test)(const DopAlignment& alignment, const SlabLine* node_M, const SlabLine* node_N,
                               int least_overlap, PairOverlaps& overlaps);

  /// Tests the thin slabs of 16 pairs; lowers overlaps and returns the mask as `test` does.
  PairMask (*test_thin)(const ThinSlabFrame& frame, const NodeHead& head_M, const SlabLine* node_M,
                        const NodeHead& head_N, const SlabLine* node_N, int least_overlap, PairOverlaps& overlaps);

  /// The greatest overlap of the pairs in the mask, which is not 0.
  int (*most_overlap)(const PairOverlaps& overlaps, PairMask pairs);

  /// Of the pairs in the mask, which is not 0, one that overlaps most but for 16 grid steps.
  int (*deepest)(const PairOverlaps& overlaps, PairMask pairs);
};

/// Those of the instruction set in use.
const NodeKernels& node_kernels();

}  // namespace glissade::collision

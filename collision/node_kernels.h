#pragma once

/// The vector code of node visits: four children of one tree against four of the other.
///
/// Pairs are numbered 4 · child_P + child_Q. `overlap` is how far the boxes of a pair overlap along the slab where they
/// do least, in grid steps of P; when negative, the boxes are certainly at least so far apart.

#include <array>
#include <cstdint>

#include <glissade/collision/dop_node.h>

#include "dop_alignment.h"
#include "thin_slab.h"

namespace glissade::collision {

/// Node of Q in the frame of P. Each row holds what faces `above` and what faces `below` of the rows of P, so that a
/// sum of lanes is an overlap.
struct alignas(64) AlignedNode {
  std::array<std::int16_t, 8 * kMostRows> facing;
};

struct alignas(32) PairOverlaps {
  std::array<std::int16_t, kWidth * kWidth> overlap;
};

/// One bit for each pair of children.
using PairMask = std::uint32_t;
inline constexpr PairMask kAllPairs = 0xffff;

struct NodeKernels {
  /// Realigns the four children of a node of Q. O(k).
  void (*realign)(const DopAlignment& alignment, const SlabLine* node_Q, AlignedNode& aligned);

  /// Tests 16 pairs; the mask has those that overlap by at least `least_overlap` ≥ −32767.
  PairMask (*test)(const SlabLine* node_P, const AlignedNode& aligned, int slabs, int least_overlap,
                   PairOverlaps& overlaps);

  /// Both in one.
  PairMask (*realign_and_test)(const DopAlignment& alignment, const SlabLine* node_P, const SlabLine* node_Q,
                               int least_overlap, PairOverlaps& overlaps);

  /// Tests the thin slabs of 16 pairs; lowers overlaps and returns the mask as `test` does.
  PairMask (*test_thin)(const ThinSlabFrame& frame, const NodeHead& head_P, const SlabLine* node_P,
                        const NodeHead& head_Q, const SlabLine* node_Q, int least_overlap, PairOverlaps& overlaps);

  /// The greatest overlap of the pairs in the mask, which is not 0.
  int (*most_overlap)(const PairOverlaps& overlaps, PairMask pairs);

  /// Of the pairs in the mask, which is not 0, one that overlaps most but for 16 grid steps.
  int (*deepest)(const PairOverlaps& overlaps, PairMask pairs);
};

/// Those of the instruction set in use.
const NodeKernels& node_kernels();

}  // namespace glissade::collision

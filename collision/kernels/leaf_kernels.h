#pragma once

/// The vector code of leaf visits: four triangles of one tree against four of the other, in single precision with an
/// error bound. What it cannot decide goes to the exact predicate.

#include "kernels/child_pairs.h"
#include "kernels/leaf_frame.h"
#include "kernels/leaf_pair.h"
#include "tree/dop_node.h"

namespace glissade::collision {

struct LeafKernels {
  /// Bring a leaf of either tree into the frame of M for the functions below, which need both.
  void (*prepare_M)(const TriangleLeaf& leaf_M, LeafPair& leaves);
  void (*prepare_N)(const LeafFrame& frame, const TriangleLeaf& leaf_N, LeafPair& leaves);

  /// A certain lower bound of the distance of the leaves, in radii of M: how far the normal of one triangle keeps all
  /// of the one from all of the other. Negative when none does.
  float (*leaf_gap)(const LeafFrame& frame, const LeafPair& leaves);

  /// The pairs that the normals do not certainly keep further apart than `distance` (radii of M).
  PairMask (*test)(const LeafFrame& frame, float distance, LeafPair& leaves);

  /// For pairs whose planes cross both triangles: whether they do so in the same place.
  CertainPairs (*cross)(const LeafFrame& frame, const LeafPair& leaves);

  /// Raises the gaps of the pairs in the mask, and perhaps of others, by what cross products of two edges tell. Returns
  /// those of the mask that are not certainly further apart than `distance` (radii of M).
  PairMask (*edges)(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves);

  /// The least gap of the pairs in the mask; 1e30 if that is empty.
  float (*least_gap)(const LeafPair& leaves, PairMask pairs);
};

/// Those of the instruction set in use.
const LeafKernels& leaf_kernels();

}  // namespace glissade::collision

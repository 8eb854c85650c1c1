#pragma once

/// The vector code of leaf visits: four triangles of one tree against four of the other, in single precision with an
/// error bound. Undecided pairs go to the exact predicate.

#include <array>

#include "kernels/child_pairs.h"
#include "kernels/leaf_frame.h"
#include "kernels/leaf_pair.h"
#include "tree/dop_node.h"

namespace glissade::collision {

struct LeafKernels {
  /// Transform a leaf of M, or of N, into the frame of M. All functions below need both leaves.
  void (*prepare_M)(const TriangleLeaf& leaf_M, LeafPair& leaves);
  void (*prepare_N)(const LeafFrame& frame, const TriangleLeaf& leaf_N, LeafPair& leaves);

  /// A certain lower bound of the distance of two leaves, in radii of M: the largest gap between all triangles of one
  /// leaf and all of the other along the normal of any triangle. Negative if no normal separates them.
  float (*leaf_gap)(const LeafFrame& frame, const LeafPair& leaves);

  /// Sets the gaps of all pairs along normals. Returns the pairs that no normal certainly separates by more than
  /// `distance` (radii of M).
  PairMask (*test)(const LeafFrame& frame, float distance, LeafPair& leaves);

  /// Raises the gaps of all pairs to those along a direction of about unit length, in the frame of M.
  void (*along)(const LeafFrame& frame, const std::array<float, 3>& direction, LeafPair& leaves);

  /// For pairs in which each triangle crosses the plane of the other: whether the triangles intersect.
  CertainPairs (*cross)(const LeafFrame& frame, const LeafPair& leaves);

  /// Raises the gaps of the pairs in the mask, and of no others, to those along cross products of two edges and,
  /// in the planes of the two triangles, across their edges. Returns the pairs of the mask that are not certainly
  /// farther apart than `distance` (radii of M).
  PairMask (*edges)(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves);

  /// The same, and sets the directions of the pairs that it returns.
  PairMask (*edges_and_directions)(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves);

  /// The least gap of the pairs in the mask; 1e30 if the mask is empty.
  float (*least_gap)(const LeafPair& leaves, PairMask pairs);
};

/// The kernels of the instruction set in use.
const LeafKernels& leaf_kernels();

}  // namespace glissade::collision

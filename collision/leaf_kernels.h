#pragma once

/// The vector code of leaf visits: four triangles of one tree against four of the other, in single precision with an
/// error bound. What it cannot decide goes to the exact predicate.

#include <array>

#include <glissade/collision/dop_node.h>

#include "node_kernels.h"
#include "query_frame.h"

namespace glissade::collision {

/// From radii of Q to those of P, in single precision.
struct LeafFrame {
  explicit LeafFrame(const QueryFrame& frame);

  std::array<std::array<float, 3>, 3> matrix;  ///< rotation times ratio
  std::array<float, 3> p_PQ;
  float uncertainty;         ///< bound on the error of a gap between two triangles along a unit vector, in radii of P
  float corner_uncertainty;  ///< bounds the error of a coordinate of a corner of P and one of Q together
  float edge_uncertainty_P;  ///< and that of the difference of two corners of P
};

/// For each pair of triangles (4 · triangle_P + triangle_Q), a certain lower bound of its distance in radii of P: how
/// far the normals of either triangle keep the two apart. Negative when they do not.
struct alignas(64) TriangleGaps {
  std::array<float, kWidth * kWidth> gap;
};

/// Four triangles in the frame of P, with what their own normals see of them.
struct alignas(64) LeafTriangles {
  using Four = std::array<float, kWidth>;
  std::array<std::array<Four, 3>, 3> corner;  ///< [axis][corner][triangle]
  std::array<Four, 3> normal;                 ///< of any length
  Four inverse_length;
  Four low;  ///< least and greatest projection of the own corners on the normal
  Four high;
  Four extent;  ///< the longer of the two edges at corner 0, rounded up
};

/// Two leaves in one frame.
struct LeafPair {
  LeafTriangles p;
  LeafTriangles q;
  TriangleGaps gaps;       ///< once they were tested
  PairMask present_P = 0;  ///< pairs whose triangle of P is there and has an area
  PairMask present_Q = 0;  ///< and whose triangle of Q

  PairMask present() const { return present_P & present_Q; }
};

/// Pairs of triangles that single precision is certain of.
struct CertainPairs {
  PairMask intersect;
  PairMask apart;
};

struct LeafKernels {
  /// Bring a leaf of either tree into the frame of P for the functions below, which need both.
  void (*prepare_P)(const TriangleLeaf& leaf_P, LeafPair& leaves);
  void (*prepare_Q)(const LeafFrame& frame, const TriangleLeaf& leaf_Q, LeafPair& leaves);

  /// A certain lower bound of the distance of the leaves, in radii of P: how far the normal of one triangle keeps all
  /// of the one from all of the other. Negative when none does.
  float (*leaf_gap)(const LeafFrame& frame, const LeafPair& leaves);

  /// The pairs that the normals do not certainly keep further apart than `distance` (radii of P).
  PairMask (*test)(const LeafFrame& frame, float distance, LeafPair& leaves);

  /// For pairs whose planes cross both triangles: whether they do so in the same place.
  CertainPairs (*cross)(const LeafFrame& frame, const LeafPair& leaves);

  /// Raises the gaps of the pairs in the mask, and perhaps of others, by what cross products of two edges tell. Returns
  /// those of the mask that are not certainly further apart than `distance` (radii of P).
  PairMask (*edges)(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves);

  /// The least gap of the pairs in the mask; 1e30 if that is empty.
  float (*least_gap)(const LeafPair& leaves, PairMask pairs);
};

/// Those of the instruction set in use.
const LeafKernels& leaf_kernels();

}  // namespace glissade::collision

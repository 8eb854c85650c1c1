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
  float corner_uncertainty;  ///< bound on the error of a coordinate of a corner
};

/// For each pair of triangles (4 · triangle_P + triangle_Q), a certain lower bound of its distance in radii of P: how
/// far the normals of either triangle keep the two apart. Negative when they do not: the more, the deeper they cross.
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
  Four extent;  ///< largest difference of coordinates between corner 0 and the others
};

/// Two leaves as `test` has prepared them for the two functions after it.
struct LeafPair {
  LeafTriangles p;
  LeafTriangles q;
  TriangleGaps gaps;
};

/// Pairs of triangles that single precision is certain of.
struct CertainPairs {
  PairMask intersect;
  PairMask apart;
};

struct LeafKernels {
  /// The pairs that the normals do not certainly keep further apart than `distance` (radii of P).
  PairMask (*test)(const LeafFrame& frame, const TriangleLeaf& leaf_P, const TriangleLeaf& leaf_Q, float distance,
                   LeafPair& leaves);

  /// For pairs whose planes cross both triangles: whether they do so in the same place.
  CertainPairs (*cross)(const LeafFrame& frame, const LeafPair& leaves);

  /// A certain lower bound of the distance of one pair, in radii of P: how far the cross product of two edges keeps the
  /// triangles apart. Negative when none does.
  float (*edge_gap)(const LeafFrame& frame, const LeafPair& leaves, int pair);
};

/// Those of the instruction set in use.
LeafKernels leaf_kernels();

}  // namespace glissade::collision

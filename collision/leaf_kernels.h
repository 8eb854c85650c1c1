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
  float uncertainty;  ///< bound on the error of a gap between two triangles along a unit vector, in radii of P
};

struct LeafKernels {
  /// The pairs (4 · triangle_P + triangle_Q) that no normal of either triangle certainly separates by more than
  /// `distance` (radii of P). `least_gap` is lowered to the least certified gap of the pairs that are separated, if
  /// that is less.
  PairMask (*test)(const LeafFrame& frame, const TriangleLeaf& leaf_P, const TriangleLeaf& leaf_Q, float distance,
                   float& least_gap);
};

/// Those of the instruction set in use.
LeafKernels leaf_kernels();

}  // namespace glissade::collision

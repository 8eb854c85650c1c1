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

/// For each pair of triangles (4 · triangle_P + triangle_Q), a certain lower bound of its distance in radii of P: how
/// far the normals of either triangle keep the two apart. Negative when they do not: the more, the deeper they cross.
struct alignas(64) TriangleGaps {
  std::array<float, kWidth * kWidth> gap;
};

struct LeafKernels {
  /// The pairs that are not certainly further apart than `distance` (radii of P).
  PairMask (*test)(const LeafFrame& frame, const TriangleLeaf& leaf_P, const TriangleLeaf& leaf_Q, float distance,
                   TriangleGaps& gaps);
};

/// Those of the instruction set in use.
LeafKernels leaf_kernels();

}  // namespace glissade::collision

#pragma once

/// Two leaves in one frame, and the gaps between their triangles.

#include <array>

#include "kernels/child_pairs.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// For each pair of triangles (4 · triangle_M + triangle_N), a certain lower bound of its distance in radii of M: the
/// largest gap along the axes that were tested. Negative if none of them separates the pair.
struct alignas(64) TriangleGaps {
  std::array<float, kWidth * kWidth> gap;
};

/// For each pair of triangles, a direction of any length along which it has its gap, in the frame of M.
struct alignas(64) TriangleDirections {
  std::array<std::array<float, kWidth * kWidth>, 3> n;  ///< [axis]
};

/// Four triangles in the frame of M, with their extents along their own normals.
struct alignas(64) LeafTriangles {
  using Four = std::array<float, kWidth>;
  std::array<std::array<Four, 3>, 3> corner;  ///< [axis][corner][triangle]
  std::array<Four, 3> normal;                 ///< of any length
  Four inverse_length;
  Four low;  ///< least and greatest projection of a triangle's corners on its normal
  Four high;
  Four extent;  ///< the longer of the two edges at corner 0, rounded up
};

/// Two leaves in one frame.
struct LeafPair {
  LeafTriangles p;
  LeafTriangles q;
  TriangleGaps gaps;  ///< set by `LeafKernels::test`
  PairMask by_N = 0;  ///< the same: pairs whose gap is along the normal of the triangle of N, not of that of M
  // Set by `LeafKernels::edges_and_directions` for the pairs that it returns:
  TriangleDirections directions;
  PairMask by_edges = 0;   ///< pairs whose direction is not a normal
  PairMask present_M = 0;  ///< pairs whose triangle of M exists and has an area
  PairMask present_N = 0;  ///< the same for the triangle of N

  PairMask present() const { return present_M & present_N; }
};

/// Pairs of triangles that are decided with certainty in single precision.
struct CertainPairs {
  PairMask intersect;
  PairMask apart;
};

}  // namespace glissade::collision

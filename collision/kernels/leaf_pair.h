#pragma once

/// Two leaves brought into one frame, and what is found of the pairs of their triangles.

#include <array>

#include "kernels/child_pairs.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// For each pair of triangles (4 · triangle_M + triangle_N), a certain lower bound of its distance in radii of M: how
/// far the normals of either triangle keep the two apart. Negative when they do not.
struct alignas(64) TriangleGaps {
  std::array<float, kWidth * kWidth> gap;
};

/// Four triangles in the frame of M, with what their own normals see of them.
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
  PairMask present_M = 0;  ///< pairs whose triangle of M is there and has an area
  PairMask present_N = 0;  ///< and whose triangle of N

  PairMask present() const { return present_M & present_N; }
};

/// Pairs of triangles that single precision is certain of.
struct CertainPairs {
  PairMask intersect;
  PairMask apart;
};

}  // namespace glissade::collision

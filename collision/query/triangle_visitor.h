#pragma once

/// What a query asks of every pair of triangles that a traversal cannot rule out.

#include <cstdint>

#include "kernels/child_pairs.h"

namespace glissade::collision {

struct NodePair;

/// What is known of a pair of triangles after a visit.
struct PairOutcome {
  bool stop;        ///< the query is answered
  double distance;  ///< in metres, no greater than the true one but for rounding; negative when it was not looked for
};

/// Pair of triangles: 4 · triangle of leaf_M + triangle of leaf_N.
class TriangleVisitor {
 public:
  /// Of the pairs of children of two nodes that may be near, those that are to be opened: all of them, unless the
  /// visitor knows better. Only asked where every pair is looked for.
  virtual PairMask to_open(const NodePair& /*nodes*/, PairMask near) { return near; }
  /// Finds out about a pair.
  virtual PairOutcome visit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) = 0;
  /// The same for a pair that is known to intersect.
  virtual PairOutcome found(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) = 0;
  /// The distance of a pair in metres; 0 when it intersects.
  virtual double distance(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) = 0;

 protected:
  ~TriangleVisitor() = default;
};

}  // namespace glissade::collision

#pragma once

/// The test that a query makes of every triangle pair that a traversal cannot exclude.

#include <bit>
#include <cstdint>

#include "kernels/child_pairs.h"
#include "kernels/leaf_pair.h"

namespace glissade::collision {

struct NodePair;

/// Result of a visit of a triangle pair.
struct PairOutcome {
  bool stop;        ///< the query is answered
  double distance;  ///< metres; up to rounding, at most the true distance; negative: not computed
};

/// Triangle pairs are numbered 4 · triangle of leaf_M + triangle of leaf_N.
class TriangleVisitor {
 public:
  /// The pairs of children to open, out of `near`, the pairs that may be near. By default all of them. Called only for
  /// Goal::kEveryPair.
  virtual PairMask to_open(const NodePair& /*nodes*/, PairMask near) { return near; }
  /// Whether it needs the directions of gaps.
  virtual bool asks_for_directions() const { return false; }
  /// The pairs of a mask, which have gaps and directions, that are to be tested; by default all of them.
  virtual PairMask to_measure(std::uint32_t /*leaf_M*/, std::uint32_t /*leaf_N*/, PairMask pairs,
                              const LeafPair& /*leaves*/) {
    return pairs;
  }
  /// Tests a triangle pair.
  virtual PairOutcome visit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) = 0;
  /// Tests the pairs in the mask, now or later. Returns whether the query is answered.
  virtual bool visit_each(std::uint32_t leaf_M, std::uint32_t leaf_N, PairMask pairs) {
    for (; pairs != 0; pairs &= pairs - 1) {
      if (visit(leaf_M, leaf_N, std::countr_zero(pairs)).stop) return true;
    }
    return false;
  }
  /// The same as `visit` for a pair that is known to intersect.
  virtual PairOutcome found(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) = 0;
  /// The distance of a pair in metres; 0 when it intersects.
  virtual double distance(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) = 0;

 protected:
  ~TriangleVisitor() = default;
};

}  // namespace glissade::collision

#pragma once

/// The place where two meshes were found to meet. Between queries, the intersection of two surfaces moves to adjacent
/// triangles, so the next search begins there.

#include <array>
#include <cstdint>

#include <glissade/collision/query_types.h>

#include "query/dop_visit.h"
#include "query/triangle_visitor.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {

/// The triangle pair that answered a query, and the pairs of nodes above it.
class LastHit {
 public:
  /// `pair` is numbered as in `TriangleVisitor`.
  LastHit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) : leaf_M_(leaf_M), leaf_N_(leaf_N), pair_(pair) {}

  /// Adds the next pair of nodes above those added so far.
  void add_above(const NodePair& nodes) {
    if (!is_full()) above_[static_cast<std::size_t>(levels_++)] = nodes;
  }
  bool is_full() const { return levels_ == kLevels; }

  /// Whether the visitor stops at this triangle pair.
  bool still_answers(TriangleVisitor& visitor) const { return visitor.visit(leaf_M_, leaf_N_, pair_).stop; }

  /// Searches for another triangle pair that certainly intersects: in the same two leaves, then below each of the nodes
  /// above, finally below the roots. If the visitor stops at one, remembers that pair and returns true. A failed search
  /// proves nothing.
  bool wander(DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor);

  /// Prefetch the memory that a query will read. Call them in this order, with other work in between: each reads what
  /// the previous one has fetched.
  void prefetch_leaves(const DopTree& base, const DopTree& other) const;
  void prefetch_triangles(const DopTree& base, const DopTree& other) const;
  void prefetch_corners(const DopTree& base, const DopTree& other) const;

 private:
  bool try_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N, DopVisit& step, QueryCounters& counters,
                  TriangleVisitor& visitor);
  bool dive(NodePair nodes, DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor);
  void put_below(const NodePair& nodes);

  std::int32_t triangle_M(const DopTree& base) const {
    return leaves_of(base)[leaf_M_].triangle[static_cast<std::size_t>(pair_ / kWidth)];
  }
  std::int32_t triangle_N(const DopTree& other) const {
    return leaves_of(other)[leaf_N_].triangle[static_cast<std::size_t>(pair_ % kWidth)];
  }

  static constexpr int kLevels = 4;

  std::uint32_t leaf_M_;
  std::uint32_t leaf_N_;
  int pair_;
  int levels_ = 0;
  std::array<NodePair, kLevels> above_{};  ///< the lowest first
};

}  // namespace glissade::collision

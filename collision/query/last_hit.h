#pragma once

/// Where two meshes were found to meet. From one query to the next the crossing of two surfaces wanders to
/// triangles next to where it was, so the next search begins there.

#include <array>
#include <cstdint>

#include <glissade/collision/query_types.h>

#include "query/dop_visit.h"
#include "query/triangle_visitor.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {

/// A pair of triangles that answered a query, and the nodes above them.
class LastHit {
 public:
  /// `pair` of two leaves, see `TriangleVisitor`.
  LastHit(std::uint32_t leaf_M, std::uint32_t leaf_N, int pair) : leaf_P_(leaf_M), leaf_Q_(leaf_N), pair_(pair) {}

  /// The next pair of nodes above those that were added.
  void add_above(const NodePair& nodes) {
    if (!is_full()) above_[static_cast<std::size_t>(levels_++)] = nodes;
  }
  bool is_full() const { return levels_ == kLevels; }

  /// Whether the visitor says stop at this pair of triangles.
  bool still_answers(TriangleVisitor& visitor) const { return visitor.visit(leaf_P_, leaf_Q_, pair_).stop; }

  /// Looks for another pair that certainly intersects: in the same two leaves, then below each of the nodes above, at
  /// last below the roots. Becomes that one if the visitor says stop. A search that fails says nothing.
  bool wander(DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor);

  /// Have the memory ready soon that a query will look at: to be called one after the other, with other work in
  /// between, because each needs what the one before has asked for.
  void prefetch_leaves(const DopTree& base, const DopTree& other) const;
  void prefetch_triangles(const DopTree& base, const DopTree& other) const;
  void prefetch_corners(const DopTree& base, const DopTree& other) const;

 private:
  bool try_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N, DopVisit& step, QueryCounters& counters,
                  TriangleVisitor& visitor);
  bool dive(NodePair nodes, DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor);
  void put_below(const NodePair& nodes);

  std::int32_t triangle_M(const DopTree& base) const {
    return base.leaves()[leaf_P_].triangle[static_cast<std::size_t>(pair_ / kWidth)];
  }
  std::int32_t triangle_N(const DopTree& other) const {
    return other.leaves()[leaf_Q_].triangle[static_cast<std::size_t>(pair_ % kWidth)];
  }

  static constexpr int kLevels = 4;

  std::uint32_t leaf_P_;
  std::uint32_t leaf_Q_;
  int pair_;
  int levels_ = 0;
  std::array<NodePair, kLevels> above_{};  ///< the lowest first
};

}  // namespace glissade::collision

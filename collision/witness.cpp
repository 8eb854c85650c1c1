#include "witness.h"

#include <algorithm>
#include <bit>

#include "prefetch.h"

namespace glissade::collision {

bool Witness::wander(DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor) {
  if (try_leaves(leaf_P_, leaf_Q_, step, counters, visitor)) return true;
  const std::array<NodePair, kLevels> above = above_;
  const int levels = levels_;
  for (int level = 0; level < levels; ++level) {
    levels_ = levels - level - 1;
    std::copy(above.begin() + level + 1, above.begin() + levels, above_.begin());
    if (dive(above[static_cast<std::size_t>(level)], step, counters, visitor)) return true;
  }
  levels_ = 0;
  return dive({0, 0, kAllPairs}, step, counters, visitor);
}

bool Witness::try_leaves(std::uint32_t leaf_P, std::uint32_t leaf_Q, DopVisit& step, QueryCounters& counters,
                         TriangleVisitor& visitor) {
  VisitedLeaves leaves;
  step.prepare(leaf_P, leaf_Q, leaves);
  PairMask near = step.leaves(leaves, counters);
  if (near != 0) near &= step.cross(leaves).intersect;
  if (near == 0) return false;
  const int pair = std::countr_zero(near);
  if (!visitor.found(leaf_P, leaf_Q, pair).stop) return false;
  leaf_P_ = leaf_P;
  leaf_Q_ = leaf_Q;
  pair_ = pair;
  return true;
}

// Down along what overlaps most.
bool Witness::dive(NodePair nodes, DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor) {
  for (;;) {
    put_below(nodes);
    PairOverlaps overlaps;
    const PairMask near = step.nodes(nodes, overlaps, counters);
    if (near == 0) return false;
    const Descent descent = step.descend(nodes, near, step.deepest(overlaps, near));
    nodes = descent.next;
    if (descent.is_leaf) return try_leaves(nodes.node_P, nodes.node_Q, step, counters, visitor);
  }
}

void Witness::put_below(const NodePair& nodes) {
  std::copy_backward(above_.begin(), above_.end() - 1, above_.end());
  above_.front() = nodes;
  levels_ = std::min(levels_ + 1, kLevels);
}

void Witness::prefetch_leaves(const DopTree& base, const DopTree& other) const {
  prefetch_lines(&base.leaves()[leaf_P_], sizeof(TriangleLeaf));
  prefetch_lines(&other.leaves()[leaf_Q_], sizeof(TriangleLeaf));
}

void Witness::prefetch_triangles(const DopTree& base, const DopTree& other) const {
  prefetch_lines(&base.mesh().triangles[static_cast<std::size_t>(triangle_P(base))], 1);
  prefetch_lines(&other.mesh().triangles[static_cast<std::size_t>(triangle_Q(other))], 1);
  if (levels_ == 0) return;
  prefetch_node(base, above_[0].node_P);
  prefetch_node(other, above_[0].node_Q);
}

void Witness::prefetch_corners(const DopTree& base, const DopTree& other) const {
  for (int c = 0; c < 3; ++c) {
    prefetch_lines(&base.mesh().corner(triangle_P(base), c), 1);
    prefetch_lines(&other.mesh().corner(triangle_Q(other), c), 1);
  }
}

}  // namespace glissade::collision

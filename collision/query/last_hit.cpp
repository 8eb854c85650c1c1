#include "query/last_hit.h"

#include <algorithm>
#include <bit>

#include "kernels/prefetch.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {

bool LastHit::wander(DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor) {
  if (try_leaves(leaf_M_, leaf_N_, step, counters, visitor)) return true;
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

bool LastHit::try_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N, DopVisit& step, QueryCounters& counters,
                         TriangleVisitor& visitor) {
  VisitedLeaves leaves;
  step.prepare(leaf_M, leaf_N, leaves);
  PairMask near = step.leaves(leaves, counters);
  if (near != 0) near &= step.cross(leaves).intersect;
  if (near == 0) return false;
  const int pair = std::countr_zero(near);
  if (!visitor.found(leaf_M, leaf_N, pair).stop) return false;
  leaf_M_ = leaf_M;
  leaf_N_ = leaf_N;
  pair_ = pair;
  return true;
}

// Descends along the greatest overlap.
bool LastHit::dive(NodePair nodes, DopVisit& step, QueryCounters& counters, TriangleVisitor& visitor) {
  for (;;) {
    put_below(nodes);
    PairOverlaps overlaps;
    const PairMask near = step.nodes(nodes, overlaps, counters);
    if (near == 0) return false;
    const Descent descent = step.descend(nodes, near, step.deepest(overlaps, near));
    nodes = descent.next;
    if (descent.is_leaf) return try_leaves(nodes.node_M, nodes.node_N, step, counters, visitor);
  }
}

void LastHit::put_below(const NodePair& nodes) {
  std::copy_backward(above_.begin(), above_.end() - 1, above_.end());
  above_.front() = nodes;
  levels_ = std::min(levels_ + 1, kLevels);
}

void LastHit::prefetch_leaves(const DopTree& base, const DopTree& other) const {
  prefetch_lines(&leaves_of(base)[leaf_M_], sizeof(TriangleLeaf));
  prefetch_lines(&leaves_of(other)[leaf_N_], sizeof(TriangleLeaf));
}

void LastHit::prefetch_triangles(const DopTree& base, const DopTree& other) const {
  prefetch_lines(&base.mesh().triangles[static_cast<std::size_t>(triangle_M(base))], 1);
  prefetch_lines(&other.mesh().triangles[static_cast<std::size_t>(triangle_N(other))], 1);
  if (levels_ == 0) return;
  prefetch_node(base, above_[0].node_M);
  prefetch_node(other, above_[0].node_N);
}

void LastHit::prefetch_corners(const DopTree& base, const DopTree& other) const {
  for (int c = 0; c < 3; ++c) {
    prefetch_lines(&base.mesh().corner(triangle_M(base), c), 1);
    prefetch_lines(&other.mesh().corner(triangle_N(other), c), 1);
  }
}

}  // namespace glissade::collision

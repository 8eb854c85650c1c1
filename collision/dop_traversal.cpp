#include "dop_traversal.h"

#include <algorithm>
#include <bit>

namespace glissade::collision {
namespace {

class Traversal {
 public:
  Traversal(Goal goal, DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor)
      : goal_(goal), step_(step), memory_(memory), visitor_(visitor) {}

  bool run() {
    memory_.stack.clear();
    if (goal_ == Goal::kAnyPair) {
      if (dive()) return true;
    } else {
      open({0, 0, kAllPairs});
    }
    while (!memory_.stack.empty()) {
      const OpenPair top = memory_.stack.back();
      memory_.stack.pop_back();
      if (expand(top)) return true;
    }
    return false;
  }

 private:
  bool dive() {
    NodePair nodes{0, 0, kAllPairs};
    while (true) {
      OpenPair& open = memory_.stack.emplace_back();
      open.nodes = nodes;
      open.near = step_.nodes(nodes, open.overlaps, memory_.counters);
      if (open.near == 0) {
        memory_.stack.pop_back();
        break;
      }
      const int pair = step_.deepest(open.overlaps, open.near);
      const Descent descent = step_.descend(open.nodes, open.near, pair);
      open.near &= ~descent.including;
      if (descent.is_leaf) {
        if (visit_leaves(descent.next.node_P, descent.next.node_Q)) return true;
        break;
      }
      nodes = descent.next;
    }
    for (OpenPair& open : memory_.stack) {
      open.near = step_.thin_slabs(open.nodes, open.near, open.overlaps);
    }
    return false;
  }

  // Looks at the children of two nodes.
  void open(const NodePair& nodes) {
    OpenPair& open = memory_.stack.emplace_back();
    open.nodes = nodes;
    open.near = step_.nodes(nodes, open.overlaps, memory_.counters);
    open.near = step_.thin_slabs(nodes, open.near, open.overlaps);
    if (open.near == 0) {
      memory_.stack.pop_back();
    } else {
      step_.prefetch(nodes, open.near);
    }
  }

  bool expand(const OpenPair& top) {
    const std::size_t first = memory_.stack.size();
    for (PairMask near = top.near; near != 0;) {
      const int pair = goal_ == Goal::kAnyPair ? step_.deepest(top.overlaps, near) : std::countr_zero(near);
      const Descent descent = step_.descend(top.nodes, near, pair);
      near &= ~descent.including;
      if (!descent.is_leaf) {
        open(descent.next);
      } else if (visit_leaves(descent.next.node_P, descent.next.node_Q)) {
        return true;
      }
    }
    if (goal_ == Goal::kAnyPair) {
      std::reverse(memory_.stack.begin() + static_cast<std::ptrdiff_t>(first), memory_.stack.end());
    }
    return false;
  }

  bool visit_leaves(std::uint32_t leaf_P, std::uint32_t leaf_Q) {
    step_.prepare(leaf_P, leaf_Q, leaves_);
    PairMask near = step_.leaves(leaves_, memory_.counters);
    if (near == 0) return false;
    const CertainPairs certain = step_.cross(leaves_);
    near &= ~certain.apart;
    for (PairMask rest = near & certain.intersect; rest != 0; rest &= rest - 1) {
      if (visitor_.found(leaf_P, leaf_Q, std::countr_zero(rest)).stop) return true;
    }
    near &= ~certain.intersect;
    if (near != 0 && step_.has_distance()) near = step_.edges(leaves_, near);
    for (PairMask rest = near; rest != 0; rest &= rest - 1) {
      if (visitor_.visit(leaf_P, leaf_Q, std::countr_zero(rest)).stop) return true;
    }
    return false;
  }

  const Goal goal_;
  DopVisit& step_;
  QueryWorkspace::Memory& memory_;
  TriangleVisitor& visitor_;
  VisitedLeaves leaves_;
};

}  // namespace

bool traverse(Goal goal, DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor) {
  return Traversal(goal, step, memory, visitor).run();
}

}  // namespace glissade::collision

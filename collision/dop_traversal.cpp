#include "dop_traversal.h"

#include <bit>

namespace glissade::collision {
namespace {

class Traversal {
 public:
  Traversal(Goal goal, DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor)
      : goal_(goal), step_(step), memory_(memory), visitor_(visitor), diving_(goal == Goal::kAnyPair) {}

  bool run() {
    memory_.stack.clear();
    open({0, 0, kAllPairs});
    while (!memory_.stack.empty()) {
      OpenPair& top = memory_.stack.back();
      if (top.thin_pending && !diving_) {
        top.near = step_.thin_slabs(top.nodes, top.near, top.overlaps);
        top.thin_pending = false;
        step_.prefetch(top.nodes, top.near);
      }
      if (top.near == 0) {
        diving_ = false;
        memory_.stack.pop_back();
      } else if (follow(top)) {
        return true;
      }
    }
    return false;
  }

 private:
  void open(const NodePair& nodes) {
    OpenPair& open = memory_.stack.emplace_back();
    open.nodes = nodes;
    open.near = step_.nodes(nodes, open.overlaps, memory_.counters);
    open.thin_pending = true;
  }

  // Looks at one pair of children. `top` is not valid any more once something was opened.
  bool follow(OpenPair& top) {
    // The order is of use only to a query that may end early.
    const int pair = goal_ == Goal::kAnyPair ? step_.deepest(top.overlaps, top.near) : std::countr_zero(top.near);
    const Descent descent = step_.descend(top.nodes, top.near, pair);
    top.near &= ~descent.including;
    if (!descent.is_leaf) {
      open(descent.next);
      return false;
    }
    diving_ = false;
    return visit_leaves(descent.next.node_P, descent.next.node_Q);
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
  bool diving_;
  VisitedLeaves leaves_;
};

}  // namespace

bool traverse(Goal goal, DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor) {
  return Traversal(goal, step, memory, visitor).run();
}

}  // namespace glissade::collision

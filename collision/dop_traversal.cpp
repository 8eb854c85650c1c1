#include "dop_traversal.h"

#include <bit>

namespace glissade::collision {
namespace {

class Traversal {
 public:
  Traversal(DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor)
      : step_(step), memory_(memory), visitor_(visitor) {}

  /// Stops at the first answer: one pair of children after the other, what overlaps most first.
  bool find_any() {
    memory_.stack.clear();
    open({0, 0, kAllPairs});
    while (!memory_.stack.empty()) {
      OpenPair& top = memory_.stack.back();
      if (top.thin_pending && !diving_) test_thin_slabs(top);
      if (top.near == 0) {
        diving_ = false;
        memory_.stack.pop_back();
      } else if (follow(top)) {
        return true;
      }
    }
    return false;
  }

  /// All children of two nodes are opened before any goes on: so their tests overlap in time.
  bool visit_all() {
    memory_.stack.clear();
    open_if_near({0, 0, kAllPairs});
    while (!memory_.stack.empty()) {
      const NodePair nodes = memory_.stack.back().nodes;
      const PairMask all = memory_.stack.back().near;
      memory_.stack.pop_back();
      for (PairMask near = all; near != 0;) {
        const Descent descent = step_.descend(nodes, near, std::countr_zero(near));
        near &= ~descent.including;
        if (!descent.is_leaf) {
          open_if_near(descent.next);
        } else if (visit_leaves(descent.next.node_P, descent.next.node_Q)) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  void test_thin_slabs(OpenPair& open) {
    open.near = step_.thin_slabs(open.nodes, open.near, open.overlaps);
    open.thin_pending = false;
    step_.prefetch(open.nodes, open.near);
  }

  void open_if_near(const NodePair& nodes) {
    open(nodes);
    test_thin_slabs(memory_.stack.back());
    if (memory_.stack.back().near == 0) memory_.stack.pop_back();
  }

  void open(const NodePair& nodes) {
    OpenPair& open = memory_.stack.emplace_back(nodes);
    open.near = step_.nodes(nodes, open.overlaps, memory_.counters);
  }

  // Looks at one pair of children. `top` is not valid any more once something was opened.
  bool follow(OpenPair& top) {
    const bool is_only = (top.near & (top.near - 1)) == 0;
    const int pair = is_only ? std::countr_zero(top.near) : step_.deepest(top.overlaps, top.near);
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

  DopVisit& step_;
  QueryWorkspace::Memory& memory_;
  TriangleVisitor& visitor_;
  bool diving_ = true;  // to the first leaves
  VisitedLeaves leaves_;
};

}  // namespace

bool traverse(Goal goal, DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor) {
  Traversal traversal(step, memory, visitor);
  return goal == Goal::kAnyPair ? traversal.find_any() : traversal.visit_all();
}

}  // namespace glissade::collision

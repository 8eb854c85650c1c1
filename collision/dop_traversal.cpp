#include "dop_traversal.h"

#include <bit>

namespace glissade::collision {
namespace {

class Traversal {
 public:
  Traversal(Goal goal, const DopTree& base, const DopTree& other, const DopVisit& step, QueryWorkspace::Memory& memory,
            TriangleVisitor& visitor)
      : base_(base), other_(other), step_(step), memory_(memory), visitor_(visitor), diving_(goal == Goal::kAnyPair) {}

  bool run() {
    memory_.stack.clear();
    open({0, 0, kAllPairs});
    while (!memory_.stack.empty()) {
      OpenPair& top = memory_.stack.back();
      if (top.thin_pending && !diving_) {
        top.near = step_.thin_slabs(top.nodes, top.near, top.overlaps);
        top.thin_pending = false;
      }
      if (top.near == 0) {
        diving_ = false;
        memory_.stack.pop_back();
      } else if (follow(top, step_.deepest(top.overlaps, top.near))) {
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
  bool follow(OpenPair& top, int pair) {
    const int p = pair / kWidth;
    const int q = pair % kWidth;
    const NodeHead& head_P = base_.nodes()[top.nodes.node_P];
    const NodeHead& head_Q = other_.nodes()[top.nodes.node_Q];
    const PairMask row = row_of(p);
    const PairMask column = column_of(q);
    if (head_P.is_leaf(p) && head_Q.is_leaf(q)) {
      top.near &= ~(row & column);
      diving_ = false;
      return visit_leaves(head_P.child(p), head_Q.child(q));
    }
    // Where a leaf meets a node, the node is opened, for all leaves that meet it.
    if (head_P.is_leaf(p)) {
      const PairMask leaves = top.near & column & (kAllPairs << (kWidth * head_P.node_count));
      top.near &= ~leaves;
      open({top.nodes.node_P, head_Q.child(q), (leaves >> q) * row_of(0)});
    } else if (head_Q.is_leaf(q)) {
      const PairMask leaves = top.near & row & ((0xfU >> head_Q.node_count << head_Q.node_count) * column_of(0));
      top.near &= ~leaves;
      open({head_P.child(p), top.nodes.node_Q, (leaves >> (kWidth * p)) * column_of(0)});
    } else {
      top.near &= ~(row & column);
      open({head_P.child(p), head_Q.child(q), kAllPairs});
    }
    return false;
  }

  bool visit_leaves(std::uint32_t leaf_P, std::uint32_t leaf_Q) {
    LeafPair leaves;
    PairMask near = step_.leaves(leaf_P, leaf_Q, leaves, memory_.counters);
    if (near == 0) return false;
    const CertainPairs certain = step_.cross(leaves);
    near &= ~certain.apart;
    for (PairMask rest = near & certain.intersect; rest != 0; rest &= rest - 1) {
      if (visitor_.found(leaf_P, leaf_Q, std::countr_zero(rest)).stop) return true;
    }
    for (PairMask rest = near & ~certain.intersect; rest != 0; rest &= rest - 1) {
      const int pair = std::countr_zero(rest);
      if (step_.edges_part(leaves, pair)) continue;
      if (visitor_.visit(leaf_P, leaf_Q, pair).stop) return true;
    }
    return false;
  }

  const DopTree& base_;
  const DopTree& other_;
  const DopVisit& step_;
  QueryWorkspace::Memory& memory_;
  TriangleVisitor& visitor_;
  bool diving_;
};

}  // namespace

bool traverse(Goal goal, const DopTree& base, const DopTree& other, const DopVisit& step,
              QueryWorkspace::Memory& memory, TriangleVisitor& visitor) {
  return Traversal(goal, base, other, step, memory, visitor).run();
}

}  // namespace glissade::collision

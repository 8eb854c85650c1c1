#include "query/dop_traversal.h"

#include <bit>
#include <limits>

#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

// Boxes of fixed directions fail at long slivers on curved surfaces: most of the work are tests of triangles then. A
// query that has found no answer by so many should look along the direction that separates the meshes where they are
// near.
bool is_futile(const QueryCounters& counters) {
  constexpr std::int64_t kFewTriangleTests = 12 * kWidth * kWidth;
  constexpr std::int64_t kTriangleTestsOfNodeTest = 2;
  return counters.triangle_tests > kFewTriangleTests + kTriangleTestsOfNodeTest * counters.node_tests;
}

class Traversal {
 public:
  Traversal(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor)
      : step_(step), memory_(memory), visitor_(visitor) {}

  /// Stops at the first answer. Visits one pair of children after another, the greatest overlap first.
  Answer find_any() {
    memory_.stack.clear();
    if (step_.boxes_apart()) return Answer::kNo;
    if (dive()) return Answer::kYes;
    while (!memory_.stack.empty()) {
      OpenPair& top = memory_.stack.back();
      if (top.near == 0) {
        memory_.stack.pop_back();
        continue;
      }
      const Descent descent = next_of(top);
      if (!descent.is_leaf) {
        open_if_near(descent.next);
      } else if (visit_leaves(descent.next.node_M, descent.next.node_N)) {
        return Answer::kYes;
      }
      if (is_futile(memory_.counters)) return Answer::kOpen;
    }
    return Answer::kNo;
  }

  void open_if_near(const NodePair& nodes) {
    PairOverlaps overlaps;
    PairMask near = step_.nodes(nodes, overlaps, memory_.counters);
    near = step_.thin_slabs(nodes, near, overlaps);
    if (near == 0) return;
    memory_.stack.push_back({nodes, near, overlaps});
    step_.prefetch(nodes, near);
  }

  /// Opens all children of two nodes before descending further, so that their tests overlap in time.
  bool continue_all(std::int64_t node_tests) {
    while (!memory_.stack.empty()) {
      if (memory_.counters.node_tests > node_tests) return false;
      const NodePair nodes = memory_.stack.back().nodes;
      PairMask near = visitor_.to_open(nodes, memory_.stack.back().near);
      memory_.stack.pop_back();
      while (near != 0) {
        const Descent descent = step_.descend(nodes, near, std::countr_zero(near));
        near &= ~descent.including;
        if (!descent.is_leaf) {
          open_if_near(descent.next);
        } else {
          visit_leaves(descent.next.node_M, descent.next.node_N);
        }
      }
    }
    return true;
  }

 private:
  // Follows the greatest overlap down to two leaves. Thin slabs help only if these leaves give no answer.
  bool dive() {
    for (Descent descent{{0, 0, kAllPairs}, false, 0}; !descent.is_leaf;) {
      OpenPair open{descent.next, 0, {}};
      open.near = step_.nodes(open.nodes, open.overlaps, memory_.counters);
      if (open.near == 0) break;
      descent = next_of(open);
      memory_.stack.push_back(open);
      if (descent.is_leaf && visit_leaves(descent.next.node_M, descent.next.node_N)) return true;
    }
    for (OpenPair& open : memory_.stack) {
      open.near = step_.thin_slabs(open.nodes, open.near, open.overlaps);
      step_.prefetch(open.nodes, open.near);
    }
    return false;
  }

  // Takes the pair of children with the greatest overlap of those still to visit.
  Descent next_of(OpenPair& open) const {
    const bool is_only = (open.near & (open.near - 1)) == 0;
    const int pair = is_only ? std::countr_zero(open.near) : step_.deepest(open.overlaps, open.near);
    const Descent descent = step_.descend(open.nodes, open.near, pair);
    open.near &= ~descent.including;
    return descent;
  }

  bool visit_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N) {
    step_.prepare(leaf_M, leaf_N, leaves_);
    PairMask near = step_.leaves(leaves_, memory_.counters);
    if (near == 0) return false;
    const CertainPairs certain = step_.cross(leaves_);
    near &= ~certain.apart;
    for (PairMask rest = near & certain.intersect; rest != 0; rest &= rest - 1) {
      if (visitor_.found(leaf_M, leaf_N, std::countr_zero(rest)).stop) return true;
    }
    near &= ~certain.intersect;
    if (near != 0 && step_.has_distance()) {
      if (visitor_.asks_for_directions()) {
        near = visitor_.to_measure(leaf_M, leaf_N, step_.edges_and_directions(leaves_, near), leaves_);
        step_.spend_on_tests(near);
      } else {
        near = step_.edges(leaves_, near);
      }
    }
    return visitor_.visit_each(leaf_M, leaf_N, near);
  }

  DopVisit& step_;
  QueryMemory& memory_;
  TriangleVisitor& visitor_;
  VisitedLeaves leaves_;
};

}  // namespace

Answer find_any(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor) {
  return Traversal(step, memory, visitor).find_any();
}

void visit_every(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor) {
  begin_all(step, memory, visitor);
  continue_all(step, memory, visitor, std::numeric_limits<std::int64_t>::max());
}

void begin_all(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor) {
  memory.stack.clear();
  if (!step.boxes_apart()) Traversal(step, memory, visitor).open_if_near({0, 0, kAllPairs});
}

bool continue_all(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor, std::int64_t node_tests) {
  return Traversal(step, memory, visitor).continue_all(node_tests);
}

}  // namespace glissade::collision

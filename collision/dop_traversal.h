#pragma once

/// The simultaneous traversal of both trees, shared by all queries: depth first, opening both nodes of a pair at once,
/// the pair whose boxes overlap most first.

#include <cstdint>
#include <vector>

#include <glissade/collision/dop_query.h>

#include "dop_visit.h"

namespace glissade::collision {

/// Two nodes whose children are being looked at.
struct OpenPair {
  NodePair nodes;
  PairMask near;      ///< pairs of children still to be looked at
  bool thin_pending;  ///< their thin slabs have not been tested
  PairOverlaps overlaps;
};

struct QueryWorkspace::Memory {
  DopAlignment alignment;
  std::vector<OpenPair> stack;
  QueryCounters counters;
};

/// What a traversal is after decides when thin slabs are worth their test.
enum class Goal {
  kAnyPair,   ///< some pair of triangles: dive to the first leaves without them, they are of use only if that fails
  kEveryPair  ///< all of them
};

/// Calls visit(leaf_P, leaf_Q, pairs of triangles that may be near, their gaps) until it returns true. Returns whether
/// it did.
template <Goal kGoal, typename Visit>
bool traverse(const DopTree& base, const DopTree& other, const DopVisit& step, QueryWorkspace::Memory& memory,
              const Visit& visit) {
  bool diving = kGoal == Goal::kAnyPair;
  const auto open_pair = [&](const NodePair& nodes) {
    OpenPair& open = memory.stack.emplace_back();
    open.nodes = nodes;
    open.near = step.nodes(nodes, open.overlaps, memory.counters);
    open.thin_pending = true;
  };

  memory.stack.clear();
  open_pair({0, 0, kAllPairs});
  TriangleGaps gaps;
  while (!memory.stack.empty()) {
    OpenPair& open = memory.stack.back();
    if (open.thin_pending && !diving) {
      open.near = step.thin_slabs(open.nodes, open.near, open.overlaps);
      open.thin_pending = false;
    }
    if (open.near == 0) {
      diving = false;
      memory.stack.pop_back();
      continue;
    }

    const int pair = step.deepest(open.overlaps, open.near);
    const int p = pair / kWidth;
    const int q = pair % kWidth;
    const NodeHead& head_P = base.nodes()[open.nodes.node_P];
    const NodeHead& head_Q = other.nodes()[open.nodes.node_Q];
    const PairMask row = 0xfU << (kWidth * p);
    const PairMask column = 0x1111U << q;
    if (head_P.is_leaf(p)) {
      if (head_Q.is_leaf(q)) {
        open.near &= ~(row & column);
        const PairMask triangles = step.leaves(head_P.child(p), head_Q.child(q), gaps, memory.counters);
        if (triangles != 0 && visit(head_P.child(p), head_Q.child(q), triangles, gaps)) return true;
        diving = false;
      } else {
        // Where a leaf meets a node, the node is opened, for all leaves that meet it.
        const PairMask leaves = open.near & column & (kAllPairs << (kWidth * head_P.node_count));
        open.near &= ~leaves;
        PairMask rows = leaves >> q;
        rows *= 0xfU;
        open_pair({open.nodes.node_P, head_Q.child(q), rows});
      }
    } else if (head_Q.is_leaf(q)) {
      const PairMask leaves = open.near & row & (0xfU >> head_Q.node_count << head_Q.node_count) * 0x1111U;
      open.near &= ~leaves;
      open_pair({head_P.child(p), open.nodes.node_Q, (leaves >> (kWidth * p)) * 0x1111U});
    } else {
      open.near &= ~(row & column);
      open_pair({head_P.child(p), head_Q.child(q), kAllPairs});
    }
  }
  return false;
}

}  // namespace glissade::collision

#pragma once

/// The simultaneous traversal of both trees, shared by all queries: from the roots down, opening both nodes of a pair
/// at once, the pair whose boxes overlap most first.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <glissade/collision/dop_query.h>

#include "dop_visit.h"

namespace glissade::collision {

struct QueryWorkspace::Memory {
  DopAlignment alignment;
  std::vector<NodePair> stack;
  QueryCounters counters;
};

/// Calls visit(leaf_P, leaf_Q, pairs of triangles that may be near) until it returns true. Returns whether it did.
template <typename Visit>
bool traverse(const DopTree& base, const DopTree& other, const DopVisit& step, QueryWorkspace::Memory& memory,
              const Visit& visit) {
  memory.stack.clear();
  memory.stack.push_back({0, 0, kAllPairs});
  PairOverlaps overlaps;
  float ignored_gap = std::numeric_limits<float>::infinity();
  while (!memory.stack.empty()) {
    const NodePair pair = memory.stack.back();
    memory.stack.pop_back();
    PairMask near = step.nodes(pair, overlaps, memory.counters);
    if (near == 0) continue;
    const NodeHead& head_P = base.nodes()[pair.node_P];
    const NodeHead& head_Q = other.nodes()[pair.node_Q];

    // In the order of overlap, the most last, where the stack begins.
    std::array<std::int32_t, kWidth * kWidth> order;
    std::size_t count = 0;
    for (; near != 0; near &= near - 1) {
      const int i = std::countr_zero(near);
      order[count++] = overlaps.overlap[static_cast<std::size_t>(i)] * 16 + i;
    }
    std::sort(order.begin(), order.begin() + count);

    // Where a leaf meets a node, the node is opened; all such pairs of one opened node make one entry.
    std::array<PairMask, kWidth> leaves_P_of{};
    std::array<PairMask, kWidth> leaves_Q_of{};
    for (std::size_t n = 0; n < count; ++n) {
      const int i = order[n] & 15;
      const int p = i / kWidth;
      const int q = i % kWidth;
      if (head_P.is_leaf(p) && !head_Q.is_leaf(q)) {
        leaves_P_of[static_cast<std::size_t>(q)] |= 0xfU << (kWidth * p);
      } else if (!head_P.is_leaf(p) && head_Q.is_leaf(q)) {
        leaves_Q_of[static_cast<std::size_t>(p)] |= 0x1111U << q;
      }
    }
    for (int c = 0; c < kWidth; ++c) {
      const auto slot = static_cast<std::size_t>(c);
      if (leaves_P_of[slot] != 0) memory.stack.push_back({pair.node_P, head_Q.child(c), leaves_P_of[slot]});
      if (leaves_Q_of[slot] != 0) memory.stack.push_back({head_P.child(c), pair.node_Q, leaves_Q_of[slot]});
    }
    for (std::size_t n = 0; n < count; ++n) {
      const int i = order[n] & 15;
      const int p = i / kWidth;
      const int q = i % kWidth;
      if (head_P.is_leaf(p) && head_Q.is_leaf(q)) {
        const PairMask triangles = step.leaves(head_P.child(p), head_Q.child(q), ignored_gap, memory.counters);
        if (triangles != 0 && visit(head_P.child(p), head_Q.child(q), triangles)) return true;
      } else if (!head_P.is_leaf(p) && !head_Q.is_leaf(q)) {
        memory.stack.push_back({head_P.child(p), head_Q.child(q), kAllPairs});
      }
    }
  }
  return false;
}

}  // namespace glissade::collision

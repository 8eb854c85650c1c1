#pragma once

/// Dual-tree traversal from the roots (paper §2.1), for queries without memory: depth first, opening both nodes of a
/// pair at once. A query for any pair follows the greatest overlap first; a query for all pairs follows the order of
/// memory.

#include <cstdint>
#include <vector>

#include <hwy/contrib/sort/vqsort.h>

#include <glissade/collision/query_types.h>

#include "query/distance_front.h"
#include "query/dop_visit.h"
#include "query/triangle_visitor.h"

namespace glissade::collision {

/// Two nodes whose children are being visited.
struct OpenPair {
  NodePair nodes;
  PairMask near;  ///< pairs of children still to visit
  PairOverlaps overlaps;
};

/// Two nodes, and a lower bound of their distance in radii of the base.
struct PromisingPair {
  NodePair nodes;
  float gap;
};

struct QueryMemory {
  DopAlignment alignment;
  std::vector<OpenPair> stack;
  std::vector<OpenPair> accepted;  ///< by the visitor of `traverse_near`
  std::vector<PromisingPair> promising;
  std::vector<DistanceFront::Entry> expired;
  std::vector<std::uint64_t> places;  ///< sort keys of triangle pairs
  hwy::Sorter sort_places;
  QueryCounters counters;
  WorkMeter* meter = nullptr;
};

/// The goal of a traversal. It decides when thin slabs are worth their test.
enum class Goal {
  /// Any one triangle pair. Dives to the first leaves without thin slabs, which are worthwhile only if that fails.
  kAnyPair,
  /// All triangle pairs.
  kEveryPair
};

enum class Answer { kYes, kNo, kOpen };

/// Passes to the visitor triangle pairs that may be near until the visitor stops: `kYes`. `kNo`: it has had all of
/// them. `kOpen`: both are slow to come. Few queries get so far, and they are better continued by `any_pair_within`.
Answer find_any(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor);

/// Passes all triangle pairs that may be near to a visitor that never stops.
void visit_every(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor);

/// The same in pieces. This function puts the roots on the stack.
void begin_all(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor);

/// Continues with the stack until the counter of node tests exceeds `node_tests`. Returns whether the stack is empty.
/// The rest may be divided among threads, because the pairs on the stack are independent.
bool continue_all(DopVisit& step, QueryMemory& memory, TriangleVisitor& visitor, std::int64_t node_tests);

}  // namespace glissade::collision

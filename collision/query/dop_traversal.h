#pragma once

/// The simultaneous traversal of both trees from the roots (paper §2.1), for queries that remember nothing: depth
/// first, opening both nodes of a pair at once. Whoever looks for any pair follows what overlaps most first; whoever
/// looks for all pairs goes in the order of memory.

#include <cstdint>
#include <vector>

#include <hwy/contrib/sort/vqsort.h>

#include <glissade/collision/query_types.h>

#include "query/dop_visit.h"
#include "query/triangle_visitor.h"

namespace glissade::collision {

/// Two nodes whose children are being looked at.
struct OpenPair {
  NodePair nodes;
  PairMask near;  ///< pairs of children still to be looked at
  PairOverlaps overlaps;
};

/// Two nodes that are at least so far apart, in metres.
struct PromisingPair {
  NodePair nodes;
  double gap;
};

struct QueryWorkspace::Memory {
  DopAlignment alignment;
  std::vector<OpenPair> stack;
  std::vector<PromisingPair> promising;
  std::vector<std::uint64_t> places;  ///< of pairs of triangles in the order of answers
  hwy::Sorter sort_places;
  QueryCounters counters;
};

/// What a traversal is after decides when thin slabs are worth their test.
enum class Goal {
  kAnyPair,   ///< some pair of triangles: dive to the first leaves without thin slabs, they are of use only if that
              ///< fails
  kEveryPair  ///< all of them
};

/// Shows the visitor every pair of triangles that may be near, until it says stop. Returns whether it did.
bool traverse(Goal goal, DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor);

/// The same for a visitor that never says stop, in pieces. First, the stack is made to hold the roots.
void begin_all(DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor);

/// Goes on with what is on the stack, until the counter of node tests exceeds `node_tests`. Returns whether nothing is
/// left. What is left may be divided: the pairs on the stack have nothing to do with each other.
bool continue_all(DopVisit& step, QueryWorkspace::Memory& memory, TriangleVisitor& visitor, std::int64_t node_tests);

}  // namespace glissade::collision

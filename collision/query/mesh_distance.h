#pragma once

/// The search for the least distance of two trees.

#include "query/dop_traversal.h"
#include "query/placed_trees.h"

namespace glissade::collision {

/// See `distance`. `front` is the memory of the last search of these trees, or null.
MeshDistance least_distance(const PlacedTrees& placed, double limit, QueryMemory& memory, DistanceFront* front);

/// For yes-or-no queries that find no answer by overlaps: whether a pair of triangles is at most `tolerance` (metres)
/// apart. Adds to the counters.
bool any_pair_within(const PlacedTrees& placed, double tolerance, QueryMemory& memory);

}  // namespace glissade::collision

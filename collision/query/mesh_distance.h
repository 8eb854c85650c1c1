#pragma once

/// The search for the least distance, for yes-or-no queries that find no answer by overlaps.

#include "query/dop_traversal.h"
#include "query/placed_trees.h"

namespace glissade::collision {

/// Whether a pair of triangles is at most `tolerance` (metres) apart. Adds to the counters.
bool any_pair_within(const PlacedTrees& placed, double tolerance, QueryMemory& memory);

}  // namespace glissade::collision

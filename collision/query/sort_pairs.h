#pragma once

/// Sorts the pairs that a query found into ascending order of their triangles.

#include <vector>

#include <glissade/collision/query_types.h>

#include "query/dop_traversal.h"

namespace glissade::collision {

void sort_pairs(std::vector<TrianglePair>& pairs, QueryMemory& memory);
void sort_pairs(std::vector<ClosePair>& pairs, QueryMemory& memory);

}  // namespace glissade::collision

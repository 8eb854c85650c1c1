#pragma once

/// Coherent queries for callers with many pairs. The memory of a pair is separate from scratch memory, of which each
/// thread needs only one.

#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>

#include "query/coherent_front.h"

namespace glissade::collision {

struct CoherentMemory {
  QueryWorkspace& scratch;
  CoherentFront& front;  ///< of this pair of trees
};

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                const CoherentMemory& memory, double tolerance);
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        const CoherentMemory& memory, std::vector<TrianglePair>& pairs, double tolerance);
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  const CoherentMemory& memory, std::vector<ClosePair>& pairs, const PairSelection& selection = {});

}  // namespace glissade::collision

#pragma once

/// Random poses of two objects: a mesh or part B about another one, A, both centred on their origins.

#include <vector>

#include "pose_source.h"
#include "query_case.h"

namespace glissade::bench {

/// Distances along each axis of approach in `zachmann_poses`.
inline constexpr std::size_t kZachmannDistances = 10;

/// Zachmann's procedure (paper §2.1.2): random orientations, and five random axes for each. Along each axis, distances
/// at equal steps from 0, where the centres coincide, to 1.001 times the separation of the bounding boxes: some parts
/// have flat faces on their boxes, and at exactly touching boxes rounding would decide. Poses of one axis follow each
/// other.
PosesOfTrees zachmann_poses(int orientations);

/// Poses at which the distance of the objects is `gap`; fewer than `count` if they are hard to find.
PosesOfTrees poses_at(double gap, std::size_t count);

/// Colliding poses between a third of the contact distance and contact, so that objects overlap like parts that a hand
/// pushes together; fewer than `count` if they are hard to find.
PosesOfTrees overlapping_poses(std::size_t count);

}  // namespace glissade::bench

#pragma once

/// The test whether two hulls are apart by the algorithm of Gilbert, Johnson and Keerthi, starting from the last query.

#include <Eigen/Core>

#include "hull/hull_pair.h"

namespace glissade::collision {

/// Whether the corners with which the last search enclosed the origin still enclose it. If so, the hulls meet.
bool old_corners_meet(const HullPair& hulls);

/// Runs GJK to its end. Returns whether a plane separates the hulls; if so, remembers the plane. Otherwise remembers
/// the corners that enclose the origin, unless rounding prevents a decision. `n_guess` is an estimate of the normal,
/// used if a plane is remembered.
bool gjk_separates(HullPair& hulls, const Eigen::Vector3d& n_guess);

}  // namespace glissade::collision

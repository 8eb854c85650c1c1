#pragma once

/// Whether two hulls are apart, by the algorithm of Gilbert, Johnson and Keerthi from where it was last time.

#include <Eigen/Core>

#include "hull/hull_pair.h"

namespace glissade::collision {

/// Whether the corners that the last search enclosed the origin with still do: then the hulls meet.
bool old_corners_meet(const HullPair& hulls);

/// To the end. Returns whether a plane separates the hulls, which is then remembered; otherwise remembers the corners
/// that enclose the origin, unless rounding prevents a decision. `n_guess` is where the normal may be, if a plane is
/// remembered.
bool gjk_separates(HullPair& hulls, const Eigen::Vector3d& n_guess);

}  // namespace glissade::collision

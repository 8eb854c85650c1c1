#pragma once

/// How deep a part is in others where it starts, for the message that it cannot start there.

#include <span>
#include <string>

#include <Eigen/Geometry>

#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// The objects that the first part overlaps at X_WV, with the length of a translation that leads out of each, such as
/// "10 mm deep in 'floor', 2.5 mm deep in 'wall'"; empty if it overlaps none. `moving_X_WB` are the poses of the
/// objects that move on their own. Cost: some hundred collision queries for each.
std::string overlaps_at(const HapticScene& scene, const Eigen::Isometry3d& X_WV,
                        std::span<const Eigen::Isometry3d> moving_X_WB);

}  // namespace glissade::apps

#pragma once

/// How deep a part is in others where it starts, and what can be done about it, for the message that it cannot start.

#include <span>
#include <string>

#include <Eigen/Geometry>

#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// The first part of the scene that overlaps other objects: each of them with the length of a translation that leads
/// out of it, and advice, to follow the message, such as ": at most 10 mm deep in 'floor', 2.5 mm deep in 'wall'; begin
/// elsewhere, or let --depenetrate push the part out of obstacles". Empty if none overlaps. One pose for each part and
/// for each object that moves on its own. Cost: some hundred collision queries for each other object.
std::string overlap_advice(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                           std::span<const Eigen::Isometry3d> moving_X_WB, bool may_depenetrate);
/// The same at the poses of the scene.
std::string overlap_advice(const HapticScene& scene, bool may_depenetrate);

}  // namespace glissade::apps

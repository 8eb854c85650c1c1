#pragma once

/// How deep a part is in others where it starts, and what can be done about it, for the message that it cannot start.

#include <span>
#include <string>

#include <Eigen/Geometry>

#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// What the part that is deepest in others touches and overlaps, such as "at most 10 mm deep in 'floor', touching
/// 'wall'"; empty if none does. One pose for each part and for each object that moves on its own. Cost: some hundred
/// collision queries for each other object that it touches.
std::string text_of_overlaps(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                             std::span<const Eigen::Isometry3d> moving_X_WB);

/// The same with advice, to follow the message that it cannot start, such as ": at most 10 mm deep in 'floor'; begin
/// elsewhere, or let --depenetrate push the part out of obstacles". Empty if none is in others.
std::string overlap_advice(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV,
                           std::span<const Eigen::Isometry3d> moving_X_WB, bool may_depenetrate);
/// The same at the poses of the scene.
std::string overlap_advice(const HapticScene& scene, bool may_depenetrate);

}  // namespace glissade::apps

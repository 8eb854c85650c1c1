#pragma once

/// Parts that start inside closed objects. Meshes are surfaces, so such a part touches nothing and can never get out.

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// A sentence for each part at one of the poses `X_WV` that is wholly inside an obstacle whose mesh is closed.
/// None for a part that intersects the obstacle.
std::vector<std::string> parts_inside(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV);
/// The same at the poses of the scene.
std::vector<std::string> parts_inside(const HapticScene& scene);

}  // namespace glissade::apps

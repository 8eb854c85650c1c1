#pragma once

#include <cstdint>

#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// A hash of all that the simulation takes from a scene: meshes, poses, margins, compliance points and scripts. A
/// script counts by a thousand of its poses.
std::uint64_t scene_hash(const HapticScene& scene);

}  // namespace glissade::apps

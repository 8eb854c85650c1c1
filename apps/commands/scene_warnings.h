#pragma once

/// What commands with a haptic scene warn of before they start.

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// Warns of sizes that are probably an error in units, and of parts that start inside closed objects. `file` is what
/// `scene` was made of.
void warn_of_scene(const Scene& file, const HapticScene& scene);

}  // namespace glissade::apps

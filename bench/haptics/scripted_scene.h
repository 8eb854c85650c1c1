#pragma once

/// Scenes whose hand follows the script of a scene file.

#include <string>

#include "sweeps/sliding_scenes.h"

namespace glissade::bench {

/// The scene of `glissade demo`, whose hand moves at `speed` (m/s) in the mean.
test_support::SlidingScene car_door_scene(double speed);

/// The same for a scene file with one movable object and a script.
test_support::SlidingScene scene_from_file(const std::string& path, double speed);

}  // namespace glissade::bench

#pragma once

/// A scene whose hand follows a script.

#include "sweeps/sliding_scenes.h"

namespace glissade::bench {

/// The scene of `glissade demo`, whose hand moves at `speed` (m/s) in the mean.
test_support::SlidingScene car_door_scene(double speed);

}  // namespace glissade::bench

#pragma once

/// The car door of the demonstration, compiled into the program so that it runs from any folder.

#include <string_view>

namespace glissade::apps {

/// `examples/scenes/car_door.yaml` as it was when the program was built.
std::string_view embedded_scene_yaml();

/// `examples/scenes/car_door_script.csv`, the trajectory of the hand in that scene.
std::string_view embedded_scene_script();

}  // namespace glissade::apps

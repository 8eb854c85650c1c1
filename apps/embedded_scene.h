#pragma once

/// The car door of the demonstration, compiled into the program so that it runs from any folder.

#include <string>
#include <string_view>

#include <glissade/apps/files/scene_file.h>

namespace glissade::apps {

/// `examples/scenes/car_door.yaml` as it was when the program was built.
std::string_view embedded_scene_yaml();

/// `examples/scenes/car_door_script.csv`, the trajectory of the hand in that scene.
std::string_view embedded_scene_script();

/// The scene in this file; with an empty name, the embedded one. Throws as `read_scene` does.
Scene read_or_embedded_scene(const std::string& path);

}  // namespace glissade::apps

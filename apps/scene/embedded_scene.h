#pragma once

/// The scenes of the demonstration, compiled into the program so that they run from any folder.

#include <string>
#include <string_view>

#include <glissade/apps/files/scene_file.h>

namespace glissade::apps {

enum class Demonstration {
  kCarDoor,     ///< examples/scenes/car_door.yaml: a hand that holds a motor rigidly from the start
  kDoorModule,  ///< examples/scenes/door_module.yaml: a hand that grasps a motor with its fingers
};

/// The scene file and the trajectory of the hand in it, as they were when the program was built.
std::string_view embedded_scene_yaml(Demonstration demonstration);
std::string_view embedded_scene_script(Demonstration demonstration);
/// The file's name of that script, for messages.
std::string embedded_script_name(Demonstration demonstration);

/// The scene in this file, opened by `open_scene`; with an empty name, that of the demonstration.
Scene read_or_embedded_scene(const std::string& path, Demonstration demonstration);

}  // namespace glissade::apps

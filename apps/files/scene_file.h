#pragma once

/// Scenes, as the program reads them from files.

#include <glissade/simulation/scene.h>

namespace glissade::apps {

/// The end of `--help` for every command that reads a scene.
inline constexpr const char* kSceneFileHelp =
    "\n"
    "\n"
    "A scene file is YAML:\n"
    "  objects:\n"
    "    - {name: door, mesh: door.stl, scale: 0.001}\n"
    "    - {name: motor, shape: {type: box}, pose: {position_m: [0, -0.2, 0]}, movable: true}\n"
    "  script: hand.csv\n"
    "An unknown key or shape is an error that lists the known ones. All keys: docs/scene_files.md in the sources.";

using simulation::parse_scene;
using simulation::read_scene;
using simulation::Scene;
using simulation::SceneMesh;
using simulation::SceneObject;
using simulation::ScenePart;

}  // namespace glissade::apps

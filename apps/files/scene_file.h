#pragma once

/// Scenes as YAML files: the objects, their poses, the part in the hand, and its goal. docs/scene_files.md describes
/// every key; a test compares that page with the lists of keys below.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/simulation/scene.h>

namespace glissade::apps {

/// The keys that the reader accepts, by the map in which they stand. A shape takes `kShapeTypeKey` and the parameters
/// of that shape in `shapes::shape_catalog`.
inline constexpr std::array<std::string_view, 3> kSceneKeys{"objects", "script", "goal"};
inline constexpr std::array<std::string_view, 11> kObjectKeys{"name",
                                                              "mesh",
                                                              "shape",
                                                              "scale",
                                                              "pose",
                                                              "movable",
                                                              "moves",
                                                              "grip_N_per_m",
                                                              "margin_m",
                                                              "gives_way",
                                                              "compliance_point_m"};
inline constexpr std::string_view kShapeTypeKey = "type";
inline constexpr std::array<std::string_view, 3> kPoseKeys{"position_m", "orientation_wxyz", "orientation_rpy_deg"};
inline constexpr std::array<std::string_view, 2> kBoxKeys{"min_m", "max_m"};

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

using simulation::Scene;
using simulation::SceneMesh;
using simulation::SceneMotion;
using simulation::SceneObject;
using simulation::ScenePart;

/// `Scene::find`, whose message says which name may have been meant.
const SceneObject& find_object(const Scene& scene, const std::string& name);

/// Reads a scene and the meshes it names.
/// Throws std::invalid_argument, one line with file, line and key or value, for every deviation from the format.
Scene read_scene(const std::string& path);

/// The same for a text in memory: `source` replaces the file's name in messages, and paths in the scene are relative to
/// `base_folder`.
Scene parse_scene(const std::string& text, const std::string& source, const std::string& base_folder);

}  // namespace glissade::apps

#pragma once

/// A scene prepared for sliding: parts that hands lead, obstacles, and objects that move on their own.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/reference/grid_check.h>
#include <glissade/simulation/scene.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// The bodies of a scene, and what checks and viewers need of it.
struct HapticScene : simulation::SceneBodies {
  std::vector<reference::PlacedMesh>
      placed_obstacles{};                   ///< `obstacles` without triangles that give way, for the check
  std::vector<viewer::ViewObject> shown{};  ///< all objects, for viewers
};

/// `simulation::bodies_of`, and the rest.
HapticScene make_haptic_scene(const Scene& scene, const std::vector<std::string>& part_names);

/// The names of the movable objects. Throws std::invalid_argument, naming the scene, when there is none.
std::vector<std::string> movable_objects(const Scene& scene);

/// `simulation::held_parts`, as the user chose.
std::vector<contact::HeldPart> held_parts(const HapticScene& scene, const SlidingChoice& choice);

/// Throws std::invalid_argument, naming scene and object, when the name of an obstacle or a moving object does not fit
/// into a cell of a CSV file.
void check_names_fit_csv(const HapticScene& scene);
/// The same for the name of this object alone.
void check_name_fits_csv(const HapticScene& scene, const std::string& name);

}  // namespace glissade::apps

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
#include <glissade/contact/sliding.h>
#include <glissade/reference/grid_check.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// A part that a hand can hold.
struct ScenePart {
  std::string name;
  std::shared_ptr<const contact::SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
};

struct HapticScene {
  std::string source;            ///< the scene file's name, for messages
  std::vector<ScenePart> parts;  ///< at least one
  std::vector<contact::Obstacle> obstacles;
  std::vector<contact::ScriptedPart> moving;            ///< the objects that move on their own
  std::vector<reference::PlacedMesh> placed_obstacles;  ///< `obstacles` without triangles that give way, for the check
  std::vector<viewer::ViewObject> shown;                ///< all objects, for viewers
  /// Names in the scene file, by the number of the body in contacts: obstacles, parts, moving objects.
  std::vector<std::string> body_names;
  std::optional<Eigen::Isometry3d> X_WGoal;  ///< of the first part

  /// Number of the part with this name; nothing if there is none.
  std::optional<std::size_t> part_number(const std::string& name) const;
  /// The names of all parts, in quotes, for messages.
  std::string part_names() const;
};

/// Takes the objects with these names as the parts, in this order. Throws std::invalid_argument, naming the scene and
/// the object, when there is no such object or no other one, when an object at its pose has no area or reaches beyond
/// ±1e9 m, when a part moves on its own, and for more than four parts and objects that move on their own.
HapticScene make_haptic_scene(const Scene& scene, const std::vector<std::string>& part_names);

/// All objects of the scene for viewers; the movable ones with the numbers that `part_names` gives them, then those
/// that move on their own.
std::vector<viewer::ViewObject> shown_objects(const Scene& scene, const std::vector<std::string>& part_names);

/// The names of the movable objects. Throws std::invalid_argument, naming the scene, when there is none.
std::vector<std::string> movable_objects(const Scene& scene);

/// All parts of a simulation: first those that hands can hold, as chosen, then the objects that move on their
/// own.
std::vector<contact::HeldPart> held_parts(const HapticScene& scene, const SlidingChoice& choice);

/// Throws std::invalid_argument, naming scene and object, when the name of an obstacle or a moving object does not fit
/// into a cell of a CSV file.
void check_names_fit_csv(const HapticScene& scene);
/// The same for the name of this object alone.
void check_name_fits_csv(const HapticScene& scene, const std::string& name);

}  // namespace glissade::apps

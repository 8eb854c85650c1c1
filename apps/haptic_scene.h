#pragma once

/// A scene prepared for sliding: one part in the hand, obstacles, and objects that move on their own.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/apps/scene_file.h>
#include <glissade/haptics/sliding.h>
#include <glissade/reference/grid_check.h>

namespace glissade::apps {

struct HapticScene {
  std::string source;  ///< the scene file's name, for messages
  std::string part_name;
  std::shared_ptr<const haptics::SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
  std::vector<haptics::Obstacle> obstacles;
  std::vector<haptics::ScriptedPart> moving;            ///< the objects that move on their own
  std::vector<reference::PlacedMesh> placed_obstacles;  ///< `obstacles` without triangles that give way, for the check
  /// Names in the scene file, by the number of the body in contacts: obstacles, the part, moving objects.
  std::vector<std::string> body_names;
  std::optional<Eigen::Isometry3d> X_WGoal;
};

/// Takes the object `part_name` as the part. Throws std::invalid_argument, naming the scene and the object, when there
/// is no such object or no other one, when an object at its pose has no area or reaches beyond ±1e9 m, when the part
/// moves on its own, and when more than three other objects do.
HapticScene make_haptic_scene(const Scene& scene, const std::string& part_name);

/// The name of the only movable object, for commands in which no other object moves. Throws std::invalid_argument,
/// naming the scene, when there is none or several, and when an object moves on its own.
std::string only_movable_object(const Scene& scene);

/// Throws std::invalid_argument, naming scene and object, when the name of an obstacle or a moving object does not fit
/// into a cell of a CSV file.
void check_names_fit_csv(const HapticScene& scene);

}  // namespace glissade::apps

#pragma once

/// A scene made ready for sliding: one part in the hand, everything else an obstacle, some of which move.

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
  std::vector<haptics::ScriptedPart> moving;            ///< what moves on its own
  std::vector<reference::PlacedMesh> placed_obstacles;  ///< `obstacles`, less what gives way, for the independent check
  /// As the scene file has them, by their numbers in contacts: the obstacles, the part, what moves.
  std::vector<std::string> body_names;
  std::optional<Eigen::Isometry3d> X_WGoal;
};

/// Takes the object `part_name` as the part. Throws std::invalid_argument, naming the scene and the object, when there
/// is no such object, nothing else in the scene, an object that, where it lies, has no area or reaches beyond ±1e9 m,
/// when the part itself moves on its own, and when more than three others do.
HapticScene make_haptic_scene(const Scene& scene, const std::string& part_name);

/// The name of the one movable object, for who lets nothing else move. Throws std::invalid_argument, naming the scene,
/// when there is none or several, and when another one moves on its own.
std::string only_movable_object(const Scene& scene);

/// Throws std::invalid_argument, naming scene and object, where an obstacle or what moves has a name that no cell of a
/// CSV file can hold.
void check_names_fit_csv(const HapticScene& scene);

}  // namespace glissade::apps

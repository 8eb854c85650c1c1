#pragma once

/// What moves in a scene: parts that slide along what they touch and never go into it, and hands that grasp them.

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/query_types.h>
#include <glissade/contact/spring.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/simulation/scene.h>

namespace glissade::simulation {

/// A scene in motion. Without hands, the caller leads the parts: each follows its ghost, the pose that it would have if
/// nothing were in the way. Hands with fingers take hold of parts by touch and lead them. Bodies are numbered as in
/// `SceneBodies`, parts and hands as in the scene. Deterministic. Not thread-safe.
class Simulation {
 public:
  /// Throws std::invalid_argument as `bodies_of` and `grasping::GraspSimulation` do, and for a scene without movable
  /// objects.
  explicit Simulation(const Scene& scene);
  Simulation(Simulation&&) noexcept = default;
  Simulation& operator=(Simulation&&) noexcept = default;

  /// Moves the parts for `milliseconds`, each towards its ghost X_WG: one pose for each part that can be held. Once a
  /// millisecond of motion; a late caller passes the whole time. After a `haptics::HapticServer` has let go of a part,
  /// the caller takes hold of it again. Throws std::invalid_argument for another number of poses, and for a scene with
  /// hands, which lead the parts.
  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds = 1.0);
  /// The same for a scene with one part; another throws, too.
  void advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) { advance({&X_WG, 1}, milliseconds); }
  /// Moves the hands of the scene for `milliseconds`, each towards its posture, and the parts with them. No posture:
  /// the tracking of the hand is lost. Not after a `haptics::HapticServer` has led the hands. Throws
  /// std::invalid_argument for another number of postures than hands.
  void advance(std::span<const std::optional<grasping::Posture>> hands, double milliseconds = 1.0);

  std::size_t part_count() const { return bodies_.parts.size(); }
  const SceneBodies& bodies() const { return bodies_; }
  /// Of the body with this number, as in `contact::Contact::obstacle`; a hand is "a hand", and −1 "nothing".
  const std::string& name_of_body(std::int32_t body) const;

  // Of the part with this number:
  /// Poses, state and contacts after the last call.
  const contact::SlidingResult& result(std::size_t part) const { return engine_.parts().result(part); }
  const Eigen::Isometry3d& X_WV(std::size_t part) const { return result(part).X_WV; }
  /// As `contact::MultiPartSliding::lag`: from the visible part to its target.
  geometry::Displacement lag(std::size_t part) const { return engine_.parts().lag(part); }
  /// What the contacts exert on the hands that hold the part, about its compliance point, in world axes. Exactly zero
  /// while nothing pushes; at rest, the spring of the coupling.
  contact::Wrench wrench(std::size_t part) const;
  /// The contacts that touch, with numbers that stay from call to call (`contact::ContactTracker`), for callers that
  /// ask after every call of `advance`. A hand that moves along the part makes new contacts. Valid until the next call.
  std::span<const contact::TrackedContact> contacts(std::size_t part);
  /// Metres to the nearest other body of the scene, hands not counted; `farthest` if nothing is nearer. 0 where the
  /// part overlaps one since the start. Cost: a query for each body.
  double clearance(std::size_t part, double farthest = std::numeric_limits<double>::infinity());

  /// Hands, work, and everything else. A `haptics::HapticServer` takes it.
  grasping::GraspSimulation& engine() & { return engine_; }
  const grasping::GraspSimulation& engine() const& { return engine_; }
  operator grasping::GraspSimulation&() & { return engine_; }

 private:
  /// The contacts of a part with their numbers.
  struct Tracked {
    contact::ContactTracker tracker;
    std::vector<Eigen::Isometry3d> X_WB;  ///< of all parts at the last update
  };

  SceneBodies bodies_;
  grasping::GraspSimulation engine_;
  std::vector<Tracked> tracked_;
  std::vector<Eigen::Isometry3d> X_WG_;
  collision::QueryWorkspace workspace_;
};

}  // namespace glissade::simulation

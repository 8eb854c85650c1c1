#pragma once

/// The simulation of a scene. Parts slide along the bodies that they touch, and never enter them. Hands grasp parts.

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/collision/query_types.h>
#include <glissade/contact/spring.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/simulation/scene.h>

namespace glissade::simulation {

/// A scene in motion. Without hands, the caller leads the parts: each part follows its ghost, i.e. the pose that the
/// part would have if nothing were in the way. Hands with fingers grasp parts by touch and lead them. Bodies are
/// numbered as in `SceneBodies`. Parts and hands are numbered as in the scene. Deterministic. Not thread-safe.
class GLISSADE_EXPORT Simulation {
 public:
  /// Throws std::invalid_argument for a scene without movable objects. Also throws what `bodies_of` and the constructor
  /// of `grasping::GraspSimulation` throw.
  explicit Simulation(const Scene& scene);
  Simulation(Simulation&&) noexcept = default;
  Simulation& operator=(Simulation&&) noexcept = default;

  /// Moves each part towards its ghost for `milliseconds`. X_WG has one pose for each part that can be held. Call this
  /// once per millisecond of motion. A late caller passes the full elapsed time as `milliseconds`. If a
  /// `haptics::HapticServer` has released a part, this call grasps the part again. Throws std::invalid_argument if the
  /// number of poses is wrong, if the time is negative or not finite, and for a scene with hands, because there the
  /// hands lead the parts.
  void advance(std::span<const Eigen::Isometry3d> X_WG, double milliseconds = 1.0);
  /// Like the other `advance`, for a scene with one part. Also throws for a scene with several parts.
  void advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) { advance({&X_WG, 1}, milliseconds); }
  /// Moves each hand of the scene towards its posture for `milliseconds`, and moves the parts with the hands.
  /// std::nullopt means that the tracking of the hand is lost. Do not call this function after a
  /// `haptics::HapticServer` has led the hands. Throws std::invalid_argument if the number of postures is wrong, and if
  /// the time is negative or not finite.
  void advance(std::span<const std::optional<grasping::Posture>> hands, double milliseconds = 1.0);

  std::size_t part_count() const { return bodies_.parts.size(); }
  const SceneBodies& bodies() const { return bodies_; }
  /// The name of the body with the number `body`, as in `contact::Contact::obstacle`. Every hand has the name "a hand";
  /// −1 has the name "nothing".
  const std::string& name_of_body(std::int32_t body) const;

  // Properties of the part with the number `part`:
  /// Poses, state and contacts after the last call.
  const contact::SlidingResult& result(std::size_t part) const { return engine_.parts().result(part); }
  const Eigen::Isometry3d& X_WV(std::size_t part) const { return result(part).X_WV; }
  /// The displacement from the visible part to its target, see `contact::MultiPartSliding::lag`.
  geometry::Displacement lag(std::size_t part) const { return engine_.parts().lag(part); }
  /// The wrench of the contacts on the hands that hold the part, about the part's compliance point, in world axes.
  /// Exactly zero while no contact pushes. At rest, the wrench balances the coupling spring.
  contact::Wrench wrench(std::size_t part) const;
  /// The touching contacts. Contacts keep their numbers from call to call (see `contact::ContactTracker`) if this
  /// function is called after every `advance`. If a hand moves along the part, its contacts get new numbers. The span
  /// is valid until the next call.
  std::span<const contact::TrackedContact> contacts(std::size_t part);
  /// Distance (metres) from the part to the nearest other body of the scene; `farthest` if no body is nearer. Hands do
  /// not count. 0 if the part intersects a body, which is possible only for overlaps at the start. Cost: one query for
  /// each body.
  double clearance(std::size_t part, double farthest = std::numeric_limits<double>::infinity());

  /// The underlying simulation, with hands and statistics. It is the argument of `haptics::HapticServer`.
  grasping::GraspSimulation& engine() & { return engine_; }
  const grasping::GraspSimulation& engine() const& { return engine_; }
  operator grasping::GraspSimulation&() & { return engine_; }

 private:
  /// The contacts of a part with their numbers.
  struct Tracked {
    contact::ContactTracker tracker;
    std::vector<Eigen::Isometry3d> X_WB;  ///< poses of all parts at the last update
  };

  SceneBodies bodies_;
  grasping::GraspSimulation engine_;
  std::vector<Tracked> tracked_;
  std::vector<Eigen::Isometry3d> X_WG_;
  collision::QueryWorkspace workspace_;
};

}  // namespace glissade::simulation

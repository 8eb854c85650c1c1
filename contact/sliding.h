#pragma once

/// Sliding contact of one part. The visible part follows the ghost as closely as the obstacles allow. The ghost is the
/// pose that the part would have if nothing were in the way. A part that starts apart from all other bodies never
/// enters another body, at rest or on its path.

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::contact {

struct SlidingOptions {
  Metaphor metaphor = Metaphor::kForceFeedback;
  std::optional<CouplingStiffness> stiffness{};  ///< default: `stiffness_of_part` of the part's radius
  SlidingRules rules{};
};

/// A part that a script moves, for example a part in the other hand. The script gives the poses of the part's ghost
/// over time. The part follows the script as far as contacts allow.
struct ScriptedPart {
  std::shared_ptr<const SlidingPart> part_B;
  geometry::PoseTrajectory script_X_WB;
  std::chrono::nanoseconds start{0};  ///< script time at which the simulation begins
  /// Stiffness k_t against translation. The stiffness against rotation is k_t ρ², where ρ is the radius of the part.
  /// The default is a thousand times the default stiffness of a hand, so the scripted part pushes other parts and
  /// hardly yields. With the stiffness of a hand, the scripted part yields as if another hand held it.
  double grip_N_per_m = 1e6;
  std::string name = "a moving part";  ///< for messages
};

/// Converts a scripted part for `MultiPartSliding`. Throws std::invalid_argument, naming the part, for a null pointer.
GLISSADE_EXPORT HeldPart held_by_script(const ScriptedPart& part);

/// The simulation of one part among fixed obstacles and scripted parts. In the underlying `MultiPartSliding`, the part
/// has number 0, and the scripted parts follow. Deterministic: the same calls give bit-identical results. Not
/// thread-safe. However, several simulations may share bodies.
class GLISSADE_EXPORT Sliding {
 public:
  /// Throws what the constructor of `MultiPartSliding` throws.
  Sliding(std::vector<Obstacle> obstacles, std::shared_ptr<const SlidingPart> part_V,
          const Eigen::Isometry3d& X_WV_start, const SlidingOptions& options = {},
          const std::vector<ScriptedPart>& scripted = {});

  /// The hand grasps the part, or grasps it anew if it already holds the part. From now on the ghost is at X_WG, even
  /// if the part is elsewhere. The part does not move in this call. The metaphor determines how the next calls of
  /// `advance` treat the offset between ghost and part:
  /// - With `force-feedback` the part closes the offset at a limited speed. Meanwhile the offset exerts no force on the
  ///   hand.
  /// - With the rubber bands the part closes the offset at unlimited speed.
  /// - With `incremental` the part keeps the offset, so that `release` and `grasp` act as a clutch.
  ///
  /// The hand holds the part from the start, so `grasp` is required only after `release`. Ignores poses that
  /// `geometry::rigid_pose` rejects.
  void grasp(const Eigen::Isometry3d& X_WG) { sliding_.grasp(0, X_WG); }

  /// The hand releases the part. The part stays at its pose, the ghost moves to the pose of the part, and no contact
  /// pushes.
  void release() { sliding_.release(0); }

  /// Moves the visible part towards its target (`SlidingResult::X_WT`) for the ghost at X_WG. Call this once per
  /// millisecond of motion. `geometry::rigid_pose` corrects X_WG to a rotation and translation. The part stands still
  /// if `rigid_pose` rejects X_WG or if the part is released. `milliseconds` (finite and not negative) is the time
  /// between the ghost poses of the last call and of this call. A late caller passes the full elapsed time, so that the
  /// part catches up. Scripts always advance by `milliseconds`.
  const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0);

  const SlidingResult& result() const { return sliding_.result(0); }
  const SlidingPart& part() const { return sliding_.part(0); }
  const CouplingStiffness& stiffness() const { return sliding_.stiffness(0); }
  /// The gap (metres) at which contacts stop the part, except contacts with obstacles that have their own margin.
  double margin() const { return sliding_.margin(0); }
  /// See `MultiPartSliding::lag`.
  geometry::Displacement lag() const { return sliding_.lag(0); }
  /// Visible poses of the scripted parts, in the order given to the constructor.
  std::span<const Eigen::Isometry3d> scripted_X_WB() const { return scripted_X_WB_; }
  const SearchStatistics& search_statistics() const { return sliding_.search_statistics(); }
  const CallStatistics& call_statistics() const { return sliding_.call_statistics(); }

  /// The minimum clearance (metres). In every step, the part provably keeps this distance from obstacles, except
  /// obstacles that have their own margin. A step that starts nearer to an obstacle keeps 95 % of its initial distance.
  double min_clearance() const { return kMinClearanceOfMargin * margin(); }

 private:
  friend struct SceneAccess;
  MultiPartSliding sliding_;
  std::vector<Eigen::Isometry3d> scripted_X_WB_;
  std::vector<Eigen::Isometry3d> ghosts_X_WG_;  // one for each part; only the first counts
};

}  // namespace glissade::contact

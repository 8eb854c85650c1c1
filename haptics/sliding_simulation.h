#pragma once

/// The interface of every method of sliding contact for one part: a hand grasps the part, moves it, and lets it go.
///
/// The ghost is the pose that the part would have if nothing were in the way. The metaphor (`Metaphor`) computes the
/// target of the part from the ghost. The visible part follows its target as far as the contacts allow.

#include <cstdint>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include <glissade/collision/frame_result.h>
#include <glissade/geometry/displacement.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

/// The work of searching for contacts, and for the pairs of triangles and boxes that must provably stay apart in the
/// next steps. The stages of `reports` find out which bodies are near; only its `total` includes the search among their
/// triangles, and the time in which a search waits for work that it may do.
struct SearchStatistics {
  std::int64_t searches = 0;  ///< number of searches whose answers were used
  /// The sum of the reports of these searches. With a search thread, times and stages differ from run to run: the
  /// pipeline starts afresh after a search that was ended early, and then remembers nothing.
  collision::FrameReport reports;
};

/// The calls of a simulation and their work.
struct CallStatistics {
  std::int64_t calls = 0;
  std::int64_t ended_early = 0;  ///< calls that ended because their work was used up
  /// Steps whose friction was not computed to the end, because its work was used up. They pass through nothing, but
  /// their forces are not in balance with the springs.
  std::int64_t unsettled_friction = 0;
  std::int64_t most_work = 0;  ///< of a call, without its searches; unit as in `SlidingRules::work_budget`
};

/// The simulation of one part in the hand. Not thread-safe.
class SlidingSimulation {
 public:
  SlidingSimulation() = default;
  SlidingSimulation(const SlidingSimulation&) = delete;
  SlidingSimulation& operator=(const SlidingSimulation&) = delete;
  virtual ~SlidingSimulation() = default;

  /// The hand grasps the part, or grasps it anew: from now on the ghost is at X_WG, wherever the part is. Nothing moves
  /// in this call. The metaphor determines how the next calls of `advance` treat the offset between ghost and part:
  /// - With `force-feedback` the part closes the offset at a limited speed. Meanwhile the hand feels no force from the
  ///   offset if the method is `Sliding` (`sliding.h`). With the paper's method the hand feels the full spring force.
  /// - With the rubber bands the part closes the offset without a limit of speed.
  /// - With `incremental` the part keeps the offset, so that `release` and `grasp` act as a clutch.
  ///
  /// The hand holds the part from the start; `grasp` is required only after `release`. Ignores poses that
  /// `geometry::rigid_pose` rejects.
  virtual void grasp(const Eigen::Isometry3d& X_WG) = 0;

  /// The hand lets go: the part stays where it is, the ghost is at the pose of the part, and no contact pushes.
  virtual void release() = 0;

  /// Moves the visible part towards its target (`SlidingResult::X_WT`) for the ghost at X_WG. Call this once per
  /// millisecond of motion. X_WG is corrected to a rotation and translation by `geometry::rigid_pose`. The part stays
  /// where it is if `rigid_pose` rejects X_WG or if the part is released. `milliseconds`, finite and not negative, is
  /// the time between the ghost poses of the last call and of this call. A caller that is late passes the whole time,
  /// so that the part catches up.
  virtual const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) = 0;

  virtual const SlidingResult& result() const = 0;

  /// Visible poses of the scripted parts, i.e. of the parts that a script moves instead of the hand, in the order given
  /// to the constructor. Empty for methods without scripted parts.
  virtual std::span<const Eigen::Isometry3d> scripted_X_WB() const { return {}; }

  virtual const SlidingPart& part() const = 0;
  virtual const CouplingStiffness& stiffness() const = 0;
  /// The gap (metres) at which contacts with obstacles that have no margin of their own stop the part. For the paper's
  /// method: the largest gap of a reported contact, as in `Contact::margin`.
  virtual double margin() const = 0;

  /// The work of searching so far; zero for methods without searches.
  virtual SearchStatistics search_statistics() const { return {}; }

  /// The states that the method's state machine went through in the last call, in order, such as
  /// "moving>bisecting>classifying>new-direction>criterion>done". Empty for methods without a state machine.
  virtual std::string trace() const { return {}; }

  /// Displacement from the visible part to its target: the stretch of the coupling's spring. Exactly zero when the
  /// part is at its target and while the part is released.
  geometry::Displacement error() const;
};

}  // namespace glissade::haptics

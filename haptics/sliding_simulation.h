#pragma once

/// The interface of every method of sliding contact for one held part: the hand takes hold, moves, and lets go.

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/frame_result.h>
#include <glissade/geometry/displacement.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

/// The work of searching for contacts. The equally many searches for pairs to certify are not included.
struct SearchAccount {
  std::int64_t searches = 0;       ///< searches whose answers were used
  collision::FrameReport reports;  ///< the sum of their reports
};

/// The simulation of one held part. Not thread-safe.
class SlidingSimulation {
 public:
  SlidingSimulation() = default;
  SlidingSimulation(const SlidingSimulation&) = delete;
  SlidingSimulation& operator=(const SlidingSimulation&) = delete;
  virtual ~SlidingSimulation() = default;

  /// The hand takes hold of the part, or takes another hold of it: from now on the ghost is at X_WG, wherever the part
  /// is. Nothing moves yet. If ghost and part do not coincide, `force-feedback` closes the gap at its limited speed
  /// (`Sliding` without pulling, the paper's method against its full spring), the rubber bands close it at once, and
  /// `incremental` keeps it, so that `grasp` and `release` are its clutch. Required only after `release`. Ignores poses
  /// that `geometry::rigid_pose` rejects.
  virtual void grasp(const Eigen::Isometry3d& X_WG) = 0;

  /// The hand lets go: the part stays where it is, the ghost is where the part is, and no contact pushes.
  virtual void release() = 0;

  /// Moves the visible part towards its target; to be called once per millisecond of motion. `geometry::rigid_pose`
  /// makes X_WG a rotation and translation; a pose that it rejects leaves the part where it is, as does a call while
  /// the part is released. `milliseconds`, finite and not negative, is the time since the ghost of the last call; a
  /// late caller may pass all of it to catch up.
  virtual const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) = 0;

  virtual const SlidingResult& result() const = 0;

  /// Visible poses of the parts that scripts move, in the order in which they were given; empty for methods without.
  virtual std::span<const Eigen::Isometry3d> scripted_X_WB() const { return {}; }

  virtual const SlidingPart& part() const = 0;
  virtual const CouplingStiffness& stiffness() const = 0;
  /// Metres at which contacts hold the part away from obstacles without a margin of their own.
  virtual double margin() const = 0;

  /// The work of searching so far; zero for methods without searches.
  virtual SearchAccount search_account() const { return {}; }

  /// States of the method's own state machine in the last call, in their order, such as "moving>bisecting>done"; empty
  /// for methods without one.
  virtual std::string trace() const { return {}; }

  /// Displacement from the visible part to its target: the stretch of the coupling's spring. Exactly zero in free space
  /// and while the part is released.
  geometry::Displacement error() const;
};

/// The contact set of the newest `result` of a part, in answer to the ghost pose of `time`. `scratch` is memory that
/// calls reuse. Works for every method and for each of several parts. Cost O(contacts).
ContactSet make_contact_set(const SlidingResult& result, const SlidingPart& part, std::int64_t sequence,
                            std::chrono::nanoseconds time, std::vector<std::int32_t>& scratch);

}  // namespace glissade::haptics

#pragma once

/// What every method of sliding contact offers to those who lead a part: the hand takes hold, moves, and lets go.

#include <span>

#include <Eigen/Geometry>

#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/motion.h>
#include <glissade/haptics/projection.h>
#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

/// How stiffly a part is held by default: 1000 N/m, and as much against rotation as that gives at its radius.
inline CouplingStiffness default_stiffness(const SlidingPart& part_V) {
  constexpr double kTranslational_N_per_m = 1000.0;
  return {kTranslational_N_per_m, kTranslational_N_per_m * part_V.radius() * part_V.radius()};
}

/// The simulation of one held part. Not thread-safe.
class SlidingSimulation {
 public:
  SlidingSimulation() = default;
  SlidingSimulation(const SlidingSimulation&) = delete;
  SlidingSimulation& operator=(const SlidingSimulation&) = delete;
  virtual ~SlidingSimulation() = default;

  /// The hand takes hold of the part, or takes another hold of it: the ghost is at X_WG from now on, wherever the part
  /// is. Nothing moves yet. Where ghost and part do not coincide, `force-feedback` closes the gap at its limited speed
  /// (`Sliding` without pulling, `PaperSliding` against its full spring),
  /// the rubber bands at once, and `incremental` leaves it as it is, which makes this and `release` its clutch. Needed
  /// only after `release`. A pose that is none to `collision::rigid_pose` changes nothing.
  virtual void grasp(const Eigen::Isometry3d& X_WG) = 0;

  /// The hand lets go: the part stays where it is, the ghost is where the part is, and no contact pushes.
  virtual void release() = 0;

  /// Moves the visible part to where the metaphor wants it, once per millisecond of motion. The ghost's pose is made a
  /// rotation and translation by `collision::rigid_pose`; what is no pose to that leaves the part where it is, as
  /// does a call while the part is released.
  /// `milliseconds`, finite and not negative, is how long ago the last call's ghost was; a caller that comes late may
  /// catch up for all of it.
  virtual const SlidingResult& advance(const Eigen::Isometry3d& X_WG, double milliseconds = 1.0) = 0;

  virtual const SlidingResult& result() const = 0;
  /// Where parts that scripts move are seen, in the order in which they were given; none where the method knows none.
  virtual std::span<const Eigen::Isometry3d> scripted_X_WB() const { return {}; }

  virtual const SlidingPart& part() const = 0;
  virtual const CouplingStiffness& stiffness() const = 0;
  /// Metres at which contacts hold the part away, where no obstacle has a margin of its own.
  virtual double margin() const = 0;

  /// From the visible part to where the metaphor wants it: the spring of the coupling is stretched by that. Exactly
  /// zero in free space and while the part is released.
  Displacement error() const { return displacement_between(result().X_WV, result().X_WT, part().p_Vref()); }
};

}  // namespace glissade::haptics

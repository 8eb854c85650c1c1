#pragma once

/// A scripted motion: poses at rising times, and every pose between them.

#include <chrono>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::geometry {

/// One row of a trajectory: the pose X_WB of some frame B in the world.
struct TimedPose {
  std::chrono::nanoseconds time{0};
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
};

/// How fast a frame B moves.
struct FrameVelocity {
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();  ///< of the origin of B, in world axes, m/s
  Eigen::Vector3d w_WB = Eigen::Vector3d::Zero();  ///< in world axes, rad/s
};

/// Between rows the translation is linear and the rotation a slerp along the shorter arc; outside, the first or last
/// pose holds. Immutable, so any number of threads may read one.
class PoseTrajectory {
 public:
  /// Throws std::invalid_argument when there is no row, and, naming the row (counted from 0), when its time does not
  /// rise above the one before, or its pose is not finite or its rotation not a rotation to within 1e-3.
  explicit PoseTrajectory(const std::vector<TimedPose>& rows);

  std::chrono::nanoseconds first_time() const noexcept { return times_.front(); }
  std::chrono::nanoseconds last_time() const noexcept { return times_.back(); }
  std::chrono::nanoseconds duration() const noexcept { return last_time() - first_time(); }

  /// The pose X_WB at `time`. Real-time safe; O(log rows).
  Eigen::Isometry3d pose_at(std::chrono::nanoseconds time) const noexcept;

  /// The exact velocity of `pose_at`: constant between two rows, that of the following piece at a row, zero outside.
  /// Real-time safe; O(log rows).
  FrameVelocity velocity_at(std::chrono::nanoseconds time) const noexcept;

  /// The same path from the same first time, stretched or squeezed to take `duration`. Throws std::invalid_argument
  /// when `duration` is not positive, or so short that two rows would fall on one nanosecond.
  PoseTrajectory time_scaled(std::chrono::nanoseconds duration) const;

 private:
  /// Index of the row that starts the piece with `time`; meaningful from the first time to below the last.
  std::size_t piece_at(std::chrono::nanoseconds time) const noexcept;

  std::vector<std::chrono::nanoseconds> times_;
  std::vector<Eigen::Vector3d> p_WB_;
  std::vector<Eigen::Quaterniond> q_WB_;
};

}  // namespace glissade::geometry

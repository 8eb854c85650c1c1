#pragma once

/// A scripted motion: poses at increasing times, with interpolation between them.

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

/// Velocity of a frame B.
struct FrameVelocity {
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();  ///< of the origin of B, in world axes; m/s
  Eigen::Vector3d w_WB = Eigen::Vector3d::Zero();  ///< in world axes; rad/s
};

/// A pose for every time. Between two rows the translation is linear and the rotation a slerp along the shorter arc.
/// Before the first row and after the last, the pose is constant. Immutable, so any number of threads may read it.
class PoseTrajectory {
 public:
  /// Throws std::invalid_argument when there is no row; and, naming the row (counted from 0), when a time is not
  /// greater than the one before, when a pose is not finite, or when its matrix is not a rotation to within 1e-3.
  explicit PoseTrajectory(const std::vector<TimedPose>& rows);

  std::chrono::nanoseconds first_time() const noexcept { return times_.front(); }
  std::chrono::nanoseconds last_time() const noexcept { return times_.back(); }
  std::chrono::nanoseconds duration() const noexcept { return last_time() - first_time(); }

  /// The pose X_WB at `time`. Real-time safe; O(log rows).
  Eigen::Isometry3d pose_at(std::chrono::nanoseconds time) const noexcept;

  /// The exact velocity of `pose_at`: constant between two rows, and at a row that of the piece that starts there. Zero
  /// before the first row, and from the last row on. Real-time safe; O(log rows).
  FrameVelocity velocity_at(std::chrono::nanoseconds time) const noexcept;

  /// The same path from the same first time, with the times scaled so that it takes `duration`. Throws
  /// std::invalid_argument when `duration` is not positive, or so short that two rows would fall on one nanosecond.
  PoseTrajectory time_scaled(std::chrono::nanoseconds duration) const;

 private:
  /// Index of the row that starts the piece containing `time`, which must be at least the first time and below the
  /// last.
  std::size_t piece_at(std::chrono::nanoseconds time) const noexcept;

  std::vector<std::chrono::nanoseconds> times_;
  std::vector<Eigen::Vector3d> p_WB_;
  std::vector<Eigen::Quaterniond> q_WB_;
};

}  // namespace glissade::geometry

#pragma once

/// A scripted motion: poses at increasing times, with interpolation between them.

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>

namespace glissade::geometry {

/// One row of a trajectory: the pose X_WB of some frame B in the world.
struct TimedPose {
  std::chrono::nanoseconds time{0};
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
};

/// Velocity of a frame B.
struct FrameVelocity {
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();  ///< velocity of the origin of B, in world axes; m/s
  Eigen::Vector3d w_WB = Eigen::Vector3d::Zero();  ///< angular velocity of B, in world axes; rad/s
};

/// A trajectory gives a pose for every time. Between two rows, the translation is linear, and the rotation is a slerp
/// along the shorter arc. Before the first row and after the last row, the pose is constant. Immutable after
/// construction, so threads may share it.
class GLISSADE_EXPORT PoseTrajectory {
 public:
  /// Throws std::invalid_argument if there is no row. Also throws, naming the row (counted from 0), in these cases:
  /// - The time of a row is not greater than the time of the row before.
  /// - A pose is not finite.
  /// - The matrix R of a pose is a reflection, or an entry of RᵀR − 1 exceeds 1e-3 in absolute value (1 is the identity
  ///   matrix).
  explicit PoseTrajectory(std::vector<TimedPose> rows);

  /// The rows, as given to the constructor or as scaled in time. The span is valid as long as the trajectory exists.
  std::span<const TimedPose> rows() const noexcept { return rows_; }
  std::chrono::nanoseconds first_time() const noexcept { return rows_.front().time; }
  std::chrono::nanoseconds last_time() const noexcept { return rows_.back().time; }
  std::chrono::nanoseconds duration() const noexcept { return last_time() - first_time(); }

  /// The pose X_WB at `time`. Real-time safe; O(log rows).
  Eigen::Isometry3d pose_at(std::chrono::nanoseconds time) const noexcept;

  /// The exact time derivative of `pose_at`. Between two rows, the velocity is constant. At a row, the result is the
  /// velocity of the piece that starts there. The velocity is zero before the first row, at the last row and after it.
  /// Real-time safe; O(log rows).
  FrameVelocity velocity_at(std::chrono::nanoseconds time) const noexcept;

  /// A trajectory with the same path and start time. All later times are scaled so that the path takes
  /// `duration`. Throws std::invalid_argument if `duration` is not positive, or is so short that two rows would have
  /// the same time in nanoseconds.
  PoseTrajectory time_scaled(std::chrono::nanoseconds duration) const;

 private:
  /// Index of the row at the start of the piece that contains `time`. `time` must be at least the first time and below
  /// the last time.
  std::size_t piece_at(std::chrono::nanoseconds time) const noexcept;

  std::vector<TimedPose> rows_;
  std::vector<Eigen::Quaterniond> q_WB_;  // rotations of the rows
};

}  // namespace glissade::geometry

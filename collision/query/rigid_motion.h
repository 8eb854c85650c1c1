#pragma once

/// The motion of a tree in the frame of another one, and how fast its points approach along a direction.

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>

namespace glissade::collision {

/// A `RigidMotion` with its velocities. One unit of time is the whole motion.
class MovingFrame {
 public:
  explicit MovingFrame(const RigidMotion& motion)
      : R_AB_begin_(motion.X_AB_begin.linear()),
        p_Bref_(motion.p_Bref),
        p_Aref_begin_(motion.X_AB_begin * motion.p_Bref),
        v_A_(motion.X_AB_end * motion.p_Bref - p_Aref_begin_),
        turn_A_(Eigen::Matrix3d(motion.X_AB_end.linear() * R_AB_begin_.transpose())) {}

  Eigen::Isometry3d X_AB(double t) const {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(t * turn_A_.angle(), turn_A_.axis()).toRotationMatrix() * R_AB_begin_;
    X.translation() = p_Aref_begin_ + t * v_A_ - X.linear() * p_Bref_;
    return X;
  }

  const Eigen::Vector3d& p_Bref() const { return p_Bref_; }
  const Eigen::Vector3d& v_A() const { return v_A_; }
  /// The greatest acceleration of points whose distance from the axis is at most `distance`.
  double acceleration(double distance) const { return turn_A_.angle() * turn_A_.angle() * distance; }
  double distance_from_axis(const Eigen::Vector3d& from_ref_A) const { return turn_A_.axis().cross(from_ref_A).norm(); }
  /// Speed along n of a point at `from_ref_A` from the reference point: v·n + m·from_ref_A, where m is this vector.
  Eigen::Vector3d turn_along(const Eigen::Vector3d& n_A) const { return turn_A_.angle() * n_A.cross(turn_A_.axis()); }
  /// The greatest speed of points whose distance from the axis is at most `distance`.
  double speed(double distance) const { return v_A_.norm() + turn_A_.angle() * distance; }

 private:
  Eigen::Matrix3d R_AB_begin_;
  Eigen::Vector3d p_Bref_;
  Eigen::Vector3d p_Aref_begin_;
  Eigen::Vector3d v_A_;
  Eigen::AngleAxisd turn_A_;
};

/// What is known now of the gap of two things along a direction: from now on, it is at least gap + rate · s − bend · s²
/// / 2 after a time s.
struct Approach {
  double gap;
  double rate;
  double bend;  // ≥ 0

  /// The time for which the gap certainly remains above `target`.
  double time_above(double target) const {
    const double spare = gap - target;
    if (!(spare > 0.0)) return 0.0;
    const double root = std::sqrt(rate * rate + 2.0 * bend * spare);
    if (rate < 0.0) return 2.0 * spare / (root - rate);
    return bend > 0.0 ? (rate + root) / bend : std::numeric_limits<double>::infinity();
  }
};

}  // namespace glissade::collision

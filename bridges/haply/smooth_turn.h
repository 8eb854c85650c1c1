#pragma once

/// The orientation of a handle that is measured in larger steps than its states come.

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::bridges {

/// Follows the measured orientation with a time constant of 15 ms: a VerseGrip measures some 60 times a second (Haply's
/// driver for CHAI3D), and its steps between 1000 states a second would look like the jumps of a broken tracker.
class SmoothTurn {
 public:
  /// The next state, `dt_s` seconds after the last one. The first one is taken as it is.
  void advance(const Eigen::Quaterniond& measured, double dt_s) {
    constexpr double kTimeConstant_s = 0.015;
    const Eigen::Quaterniond last = orientation_;
    const bool follows = is_known_ && dt_s > 0.0;
    orientation_ = follows ? last.slerp(1.0 - std::exp(-dt_s / kTimeConstant_s), measured) : measured;
    is_known_ = true;
    rate_.setZero();
    if (!follows) return;
    const Eigen::AngleAxisd turn(orientation_ * last.conjugate());
    rate_ = turn.angle() / dt_s * turn.axis();
  }

  const Eigen::Quaterniond& orientation() const noexcept { return orientation_; }
  /// rad/s, in the axes in which the orientation is given.
  const Eigen::Vector3d& rate() const noexcept { return rate_; }

 private:
  bool is_known_ = false;
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
};

}  // namespace glissade::bridges

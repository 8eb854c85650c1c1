#pragma once

/// The limits of a wrench and of joint torques that remember nothing, or only the mean.

#include "envelope/forces.h"

namespace glissade::devices {

/// Norms, and the mean of the force over about ten seconds.
class NormLimit {
 public:
  NormLimit(const DeviceDescriptor& descriptor, double period_s) : descriptor_(descriptor), period_s_(period_s) {}

  void limit(Forces& forces, LimitReasons& reasons) const noexcept;
  /// The largest force that the mean permits, N.
  double largest_force() const noexcept;
  void observe_given(const Eigen::Vector3d& f, double dt) noexcept;

 private:
  const DeviceDescriptor& descriptor_;
  double period_s_;
  double mean_force_ = 0.0;
};

/// The power that a wrench puts into a hand of this velocity. A force against the motion is not limited.
void limit_power(Forces& forces, const GloveState& state, double max_power, LimitReasons& reasons) noexcept;

/// Rates of change, which come last. Force and torque are never greater than falls to zero within 15 periods: at 1 kHz,
/// a force that falls in 20 gives more energy than is there.
class RateLimit {
 public:
  RateLimit(const DeviceDescriptor& descriptor, double period_s);

  void limit(Forces& forces, const Forces& last, double dt, LimitReasons& reasons) const noexcept;

  /// Seconds in which the wrench falls to zero.
  double time_to_zero(const Forces& forces) const noexcept;

  double force_rate() const noexcept { return force_rate_; }    ///< N/s
  double torque_rate() const noexcept { return torque_rate_; }  ///< Nm/s
  double max_force() const noexcept { return max_force_; }
  double max_torque() const noexcept { return max_torque_; }

 private:
  double force_rate_;   // N/s
  double torque_rate_;  // Nm/s
  double joint_torque_rate_;
  double max_force_;
  double max_torque_;
};

}  // namespace glissade::devices

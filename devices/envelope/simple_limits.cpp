#include "envelope/simple_limits.h"

#include <algorithm>
#include <cmath>

#include "envelope/envelope_settings.h"
#include "envelope/fade.h"

namespace glissade::devices {
namespace {

/// Scales `vector` down to the norm `limit` if it exceeds it; returns whether it did.
bool limit_norm(Eigen::Vector3d& vector, double limit) noexcept {
  // Division by the largest component comes first: the squares of huge components would overflow, and so might their
  // sum.
  const double largest = vector.lpNorm<Eigen::Infinity>();
  if (largest <= limit && vector.norm() <= limit) return false;
  vector /= largest;
  vector *= limit / vector.norm();
  // Rounding may have left the norm a few units in the last place too large.
  constexpr double kJustBelowOne = 1.0 - 1e-15;
  if (vector.norm() > limit) vector *= kJustBelowOne;
  return true;
}

/// Moves `value` to `last` plus at most `step` of the way to it; returns whether that is short of it.
bool limit_step(Eigen::Vector3d& value, const Eigen::Vector3d& last, double step) noexcept {
  Eigen::Vector3d change = value - last;
  if (!limit_norm(change, step)) return false;
  value = last + change;
  return true;
}

double rate_or_default(double rate, double maximum, const DeviceDescriptor& descriptor) noexcept {
  return rate > 0.0 ? rate : maximum * descriptor.update_rate / kEnvelope.fade_periods;
}

double seconds_to_zero(const Eigen::Vector3d& vector, double rate) noexcept {
  return vector.isZero(0.0) ? 0.0 : vector.norm() / rate;
}

}  // namespace

void NormLimit::limit(Forces& forces, LimitReasons& reasons) const noexcept {
  // What a device does not exert at all is not at a limit.
  reasons.force_limited = limit_norm(forces.f, descriptor_.max_force) && descriptor_.max_force > 0.0;
  reasons.torque_limited = limit_norm(forces.t, descriptor_.max_torque) && descriptor_.max_torque > 0.0;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    const double joint_limit = descriptor_.undriven_joints[j] ? 0.0 : descriptor_.max_joint_torque;
    double& torque = forces.joints[j];
    if (std::abs(torque) <= joint_limit) continue;
    torque = std::copysign(joint_limit, torque);
    if (joint_limit > 0.0) reasons.joints_limited = true;
  }
  reasons.mean_limited = limit_norm(forces.f, largest_force());
}

double NormLimit::largest_force() const noexcept {
  const double largest_mean = descriptor_.max_mean_force;
  if (largest_mean <= 0.0 || largest_mean >= descriptor_.max_force) return descriptor_.max_force;
  // A force far above its mean raises the mean by a share of itself in each period, so the slope at which the limit
  // falls is the share by which the force falls.
  const double steepest = kEnvelope.mean_change * kEnvelope.mean_time_s / period_s_;
  const double surplus = descriptor_.max_force - largest_mean;
  const double soft = std::max((1.0 - kEnvelope.soft_mean) * largest_mean, surplus / steepest);
  return largest_mean + surplus * std::clamp((largest_mean - mean_force_) / soft, 0.0, 1.0);
}

void NormLimit::observe_given(const Eigen::Vector3d& f, double dt) noexcept {
  mean_force_ += std::min(1.0, dt / kEnvelope.mean_time_s) * (f.norm() - mean_force_);
}

void limit_power(Forces& forces, const GloveState& state, double max_power, LimitReasons& reasons) noexcept {
  const double power = forces.f.dot(state.v_WH) + forces.t.dot(state.w_WH);
  if (power <= max_power) return;
  // Velocities near the largest numbers make a power that is infinite or none.
  forces.scale_wrench(std::isfinite(power) ? max_power / power : 0.0);
  reasons.power_limited = true;
}

RateLimit::RateLimit(const DeviceDescriptor& descriptor, double period_s)
    : force_rate_(rate_or_default(descriptor.max_force_rate, descriptor.max_force, descriptor)),
      torque_rate_(rate_or_default(descriptor.max_torque_rate, descriptor.max_torque, descriptor)),
      joint_torque_rate_(joint_torque_rate(descriptor)),
      max_force_(std::min(descriptor.max_force, force_rate_ * (kEnvelope.longest_fall_periods * period_s))),
      max_torque_(std::min(descriptor.max_torque, torque_rate_ * (kEnvelope.longest_fall_periods * period_s))) {}

void RateLimit::limit(Forces& forces, const Forces& last, double dt, LimitReasons& reasons) const noexcept {
  const bool force_limited = limit_step(forces.f, last.f, force_rate_ * dt);
  const bool torque_limited = limit_step(forces.t, last.t, torque_rate_ * dt);
  // The sum above may exceed a limit by rounding.
  limit_norm(forces.f, max_force_);
  limit_norm(forces.t, max_torque_);
  reasons.rate_limited = reasons.rate_limited || force_limited || torque_limited;
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    const double step = joint_torque_rate_ * dt;
    const double limited = std::clamp(forces.joints[i], last.joints[i] - step, last.joints[i] + step);
    reasons.rate_limited = reasons.rate_limited || limited != forces.joints[i];
    forces.joints[i] = limited;
  }
}

double RateLimit::time_to_zero(const Forces& forces) const noexcept {
  return std::max(seconds_to_zero(forces.f, force_rate_), seconds_to_zero(forces.t, torque_rate_));
}

}  // namespace glissade::devices

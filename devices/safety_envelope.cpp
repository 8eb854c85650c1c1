#include <algorithm>
#include <cmath>

#include <glissade/devices/safety_envelope.h>

#include "envelope/envelope_numbers.h"
#include "envelope/given_wrenches.h"

namespace glissade::devices {
namespace {

using std::chrono::nanoseconds;

constexpr double kFadePeriods = 7.0;
constexpr double kLongestFallPeriods = 15.0;  // at 1 kHz, a force that falls in 20 gives more energy than is there
constexpr double kReturn_s = 0.2;
constexpr double kMeanTime_s = 10.0;
constexpr double kSoftMean = 0.9;  // share of the largest mean from which the force is reduced

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
  return rate > 0.0 ? rate : maximum * descriptor.update_rate / kFadePeriods;
}

}  // namespace

SafetyEnvelope::SafetyEnvelope(const DeviceDescriptor& descriptor, double patience_periods,
                               nanoseconds period_of_caller)
    : descriptor_(descriptor), energy_(kStartEnergy_J), refill_(kMostRefill_J), enough_(kStartEnergy_J) {
  validate(descriptor_);
  const auto rounded = [](std::chrono::duration<double> time) { return std::chrono::duration_cast<nanoseconds>(time); };
  const nanoseconds of_device = rounded(std::chrono::duration<double>(1.0 / descriptor_.update_rate));
  period_ = std::max(period_of_caller, of_device);
  patience_ = rounded(patience_periods * std::chrono::duration<double>(period_));
  force_rate_ = rate_or_default(descriptor_.max_force_rate, descriptor_.max_force, descriptor_);
  torque_rate_ = rate_or_default(descriptor_.max_torque_rate, descriptor_.max_torque, descriptor_);
  const double longest_fall_s = kLongestFallPeriods * in_seconds(period_);
  descriptor_.max_force = std::min(descriptor_.max_force, force_rate_ * longest_fall_s);
  descriptor_.max_torque = std::min(descriptor_.max_torque, torque_rate_ * longest_fall_s);
  joint_torque_rate_ = joint_torque_rate(descriptor_);
  const double lag = lag_of(descriptor_, period_, nanoseconds(0));
  stiffness_ = std::min(descriptor_.max_stiffness,
                        passive_limit(descriptor_, descriptor_.damping, descriptor_.max_stiffness, lag));
  rotational_stiffness_ =
      std::min(descriptor_.max_rotational_stiffness,
               passive_limit(descriptor_, descriptor_.rotational_damping, descriptor_.max_rotational_stiffness, lag));
  given_ = std::make_unique<GivenWrenches>(descriptor_.delay,
                                           std::max<nanoseconds>(kExertedWithoutCommand, 2 * period_), of_device);
}

SafetyEnvelope::SafetyEnvelope(SafetyEnvelope&&) noexcept = default;
SafetyEnvelope& SafetyEnvelope::operator=(SafetyEnvelope&&) noexcept = default;
SafetyEnvelope::~SafetyEnvelope() = default;

SafeCommand SafetyEnvelope::limit(const GloveCommand& wanted, const GloveState& newest, nanoseconds now) noexcept {
  const double dt = seconds_since_last_call(now);
  observe(newest, now);

  SafeCommand safe;
  LimitReasons& reasons = safe.reasons_;
  reasons = faults(wanted, newest, now);
  if (!reasons.not_finite) {
    safe.age_ = age_of(wanted.state_time, now);
    safe.state_age_ = age_of(state_.time, now);
    observe_delay(safe.age_, now);
  }
  if (is_finite(wanted)) {
    wanted_ = {wanted.f_H_W, wanted.t_H_W, wanted.joint_torques};
    take_supply(wanted, reasons.is_fading(), dt);
  }
  const double change = reasons.is_fading() ? -dt / (kFadePeriods * in_seconds(period_)) : dt / kReturn_s;
  gain_ = std::clamp(gain_ + change, 0.0, 1.0);
  reasons.is_returning = !reasons.is_fading() && gain_ < 1.0;

  Forces forces = reasons.is_fading() ? faded(dt) : wanted_;
  limit_norms(forces, reasons);
  if (!reasons.is_fading()) {
    forces.f *= gain_;
    forces.t *= gain_;
    for (double& torque : forces.joints)
      torque *= gain_;
  }
  limit_power(forces, reasons);
  settle_energy(forces, now, dt);
  limit_energy(forces, reasons);
  limit_rates(forces, dt, reasons);
  // Cannot happen; but NaN would pass all limits above, and stay.
  if (!forces.f.allFinite() || !forces.t.allFinite() || !all_finite(forces.joints)) forces = {};
  // The return begins at zero, however soon the force was there.
  const bool is_zero = forces.f.isZero(0.0) && forces.t.isZero(0.0) && forces.joints == hands::JointValues{};
  if (reasons.is_fading() && is_zero) gain_ = 0.0;
  mean_force_ += std::min(1.0, dt / kMeanTime_s) * (forces.f.norm() - mean_force_);
  last_ = forces;
  observe_share(forces);
  given_->give(now, forces.f, forces.t);

  safe.energy_ = energy_;
  safe.taken_ = taken_;
  safe.values_ = wanted;
  safe.values_.supply = supply_;
  safe.values_.f_H_W = forces.f;
  safe.values_.t_H_W = forces.t;
  safe.values_.joint_torques = forces.joints;
  return safe;
}

double SafetyEnvelope::seconds_since_last_call(nanoseconds now) noexcept {
  const nanoseconds passed = has_been_called_ ? now - last_call_ : nanoseconds(0);
  has_been_called_ = true;
  last_call_ = now;
  return in_seconds(std::clamp(passed, nanoseconds(0), 2 * period_));
}

// Straight to zero, so that a change of the wanted direction cannot make the fade longer.
SafetyEnvelope::Forces SafetyEnvelope::faded(double dt) const noexcept {
  const double share = dt / (kFadePeriods * in_seconds(period_));
  const auto shorter = [](const Eigen::Vector3d& vector, double by) {
    const double norm = vector.norm();
    return norm > by ? Eigen::Vector3d((1.0 - by / norm) * vector) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  Forces forces{shorter(last_.f, share * descriptor_.max_force), shorter(last_.t, share * descriptor_.max_torque), {}};
  const double by = share * descriptor_.max_joint_torque;
  for (std::size_t i = 0; i < hands::kJoints; ++i)
    forces.joints[i] = last_.joints[i] - std::clamp(last_.joints[i], -by, by);
  return forces;
}

void SafetyEnvelope::limit_norms(Forces& forces, LimitReasons& reasons) const noexcept {
  reasons.force_limited = limit_norm(forces.f, descriptor_.max_force);
  reasons.torque_limited = limit_norm(forces.t, descriptor_.max_torque);
  const double joint_limit = descriptor_.max_joint_torque;
  for (double& torque : forces.joints) {
    if (std::abs(torque) <= joint_limit) continue;
    torque = std::copysign(joint_limit, torque);
    reasons.joints_limited = true;
  }
  const double largest_mean = descriptor_.max_mean_force;
  if (largest_mean <= 0.0 || largest_mean >= descriptor_.max_force) return;
  const double excess = std::clamp((mean_force_ / largest_mean - kSoftMean) / (1.0 - kSoftMean), 0.0, 1.0);
  const double limit = descriptor_.max_force + excess * (largest_mean - descriptor_.max_force);
  reasons.mean_limited = excess > 0.0 && limit_norm(forces.f, limit);
}

void SafetyEnvelope::limit_power(Forces& forces, LimitReasons& reasons) const noexcept {
  const double power = forces.f.dot(state_.v_WH) + forces.t.dot(state_.w_WH);
  if (power <= descriptor_.max_power) return;
  // Velocities near the largest numbers make a power that is infinite or none.
  const double share = std::isfinite(power) ? descriptor_.max_power / power : 0.0;
  forces.f *= share;
  forces.t *= share;
  reasons.power_limited = true;
}

void SafetyEnvelope::limit_rates(Forces& forces, double dt, LimitReasons& reasons) const noexcept {
  const bool force_limited = limit_step(forces.f, last_.f, force_rate_ * dt);
  const bool torque_limited = limit_step(forces.t, last_.t, torque_rate_ * dt);
  // The sum above may exceed a limit by rounding.
  limit_norm(forces.f, descriptor_.max_force);
  limit_norm(forces.t, descriptor_.max_torque);
  reasons.rate_limited = force_limited || torque_limited;
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    const double step = joint_torque_rate_ * dt;
    const double limited = std::clamp(forces.joints[i], last_.joints[i] - step, last_.joints[i] + step);
    reasons.rate_limited = reasons.rate_limited || limited != forces.joints[i];
    forces.joints[i] = limited;
  }
}

}  // namespace glissade::devices

#include "envelope/finger_limits.h"

#include <algorithm>
#include <cmath>

#include "envelope/envelope_settings.h"

namespace glissade::devices {
namespace {

bool is_absent(const JointLimit& limit) noexcept {
  return limit.max_torque <= 0.0 || limit.stiffness <= 0.0;
}

/// Moves the limit `share` of the way from `last`.
JointLimit between(const JointLimit& last, const JointLimit& next, double share) noexcept {
  JointLimit limit = next;
  limit.lower = std::lerp(last.lower, next.lower, share);
  limit.upper = std::lerp(last.upper, next.upper, share);
  limit.stiffness = std::lerp(last.stiffness, next.stiffness, share);
  limit.max_torque = std::lerp(last.max_torque, next.max_torque, share);
  return limit;
}

}  // namespace

FingerLimits::FingerLimits(const DeviceDescriptor& descriptor, double period_s)
    : descriptor_(descriptor),
      stiffness_(passive_limit_stiffness(descriptor)),
      torque_rate_(joint_torque_rate(descriptor)),
      fade_s_(kEnvelope.fade_periods * period_s),
      longest_expiry_(std::max<std::chrono::nanoseconds>(
          kEnvelope.exerted_without_command,
          std::chrono::duration_cast<std::chrono::nanoseconds>(
              std::chrono::duration<double>(kEnvelope.limits_last_periods * period_s)))),
      energy_(kEnvelope.limits_start_J) {}

const JointLimits& FingerLimits::limit(const JointLimits& wanted, const hands::JointValues& angles, bool is_fading,
                                       const Fade& fade, double dt, LimitReasons& reasons) noexcept {
  if (stiffness_ <= 0.0) return last_;
  observe_rates(angles, dt);
  const bool are_resting = resting_for_s_ > kEnvelope.rested_s;
  const double refill_W = are_resting ? kEnvelope.limits_rest_refill_W : kEnvelope.limits_refill_W;
  energy_ += refill_W * dt;
  JointLimits next;
  next.expiry = longest_expiry_;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    JointLimit& limit = next.joints[j];
    const JointLimit& last = last_.joints[j];
    if (is_fading) {
      limit = last;
      limit.max_torque = std::max(0.0, last.max_torque - dt / fade_s_ * descriptor_.max_joint_torque);
      if (limit.max_torque == 0.0) limit = {};
      continue;
    }
    limit = within_device(wanted.joints[j], reasons);
    limit.max_torque *= fade.gain();
    if (is_absent(limit)) limit = {};
    if (tighten(limit, last, angles[j], dt)) reasons.rate_limited = true;
  }
  if (pay(angles, next)) reasons.energy_limited = true;
  energy_ =
      std::min(energy_, std::max(kEnvelope.limits_start_J, kEnvelope.limits_most_rad * descriptor_.max_joint_torque));
  last_ = next;
  return last_;
}

void FingerLimits::observe_rates(const hands::JointValues& angles, double dt) noexcept {
  if (dt <= 0.0) return;
  const double share = std::min(1.0, dt / kEnvelope.finger_rate_s);
  double fastest = 0.0;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    rates_[j] += share * ((angles[j] - last_angles_[j]) / dt - rates_[j]);
    fastest = std::max(fastest, std::abs(rates_[j]));
  }
  last_angles_ = angles;
  resting_for_s_ = fastest < kEnvelope.resting_rad_per_s ? resting_for_s_ + dt : 0.0;
}

JointLimit FingerLimits::within_device(const JointLimit& wanted, LimitReasons& reasons) const noexcept {
  JointLimit limit = wanted;
  if (is_absent(limit) || limit.lower > limit.upper) return {};
  if (limit.max_torque > descriptor_.max_joint_torque) reasons.joints_limited = true;
  limit.max_torque = std::min(limit.max_torque, descriptor_.max_joint_torque);
  limit.stiffness = std::min(limit.stiffness, stiffness_);
  limit.damping = std::clamp(limit.damping, 0.0, descriptor_.joint_damping);
  return limit;
}

/// So that the torque on the finger where it is now rises no faster than the device's rate. A limit that opens, does so
/// at once: a torque that vanishes pushes nobody. Returns whether the limit tightens less than wanted.
bool FingerLimits::tighten(JointLimit& limit, const JointLimit& last, double angle, double dt) const noexcept {
  const double most = std::abs(limit_torque(last, angle, 0.0)) + torque_rate_ * dt;
  if (is_absent(limit) || std::abs(limit_torque(limit, angle, 0.0)) <= most) return false;
  const JointLimit wanted = limit;
  // Where the spring gives just that torque; but no farther out than the limit that the finger has felt.
  const double excess = most / limit.stiffness;
  if (angle > limit.upper) limit.upper = std::max(limit.upper, std::min(last.upper, angle - excess));
  if (angle < limit.lower) limit.lower = std::min(limit.lower, std::max(last.lower, angle + excess));
  // A limit that stays where it was, and may push harder.
  if (std::abs(limit_torque(limit, angle, 0.0)) > most) limit.max_torque = std::min(limit.max_torque, most);
  return limit != wanted;
}

/// Books the energy that the springs gain where the fingers are now. Returns whether it exceeds the account: then the
/// limits move only so far as it pays for.
bool FingerLimits::pay(const hands::JointValues& angles, JointLimits& next) noexcept {
  const auto gain_of = [&](double share) {
    double gain = 0.0;
    for (std::size_t j = 0; j < hands::kJoints; ++j) {
      const JointLimit& last = last_.joints[j];
      const JointLimit limit = share == 1.0 ? next.joints[j] : between(last, next.joints[j], share);
      gain += stored_energy(limit, angles[j]) - stored_energy(last, angles[j]);
    }
    return gain;
  };
  const double wanted = gain_of(1.0);
  if (wanted <= energy_) {
    energy_ -= wanted;
    return false;
  }
  double share = 0.0;
  for (double step = 0.5; step > 1e-6; step *= 0.5) {
    if (gain_of(share + step) <= energy_) share += step;
  }
  energy_ -= gain_of(share);
  for (std::size_t j = 0; j < hands::kJoints; ++j)
    next.joints[j] = between(last_.joints[j], next.joints[j], share);
  return true;
}

}  // namespace glissade::devices

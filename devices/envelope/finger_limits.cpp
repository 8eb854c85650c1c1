#include "envelope/finger_limits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "envelope/envelope_numbers.h"
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
  limit.damping = std::lerp(last.damping, next.damping, share);
  limit.max_torque = std::lerp(last.max_torque, next.max_torque, share);
  return limit;
}

}  // namespace

FingerLimits::FingerLimits(const DeviceDescriptor& descriptor, double period_s)
    : descriptor_(descriptor),
      stiffness_(passive_limit_stiffness(descriptor)),
      torque_rate_(joint_torque_rate(descriptor)),
      fade_s_(kEnvelope.fade_periods * period_s),
      expiry_(expiry_of_limits(period_s)),
      energy_(kEnvelope.limits_start_J) {}

const JointLimits& FingerLimits::limit(const JointLimits& wanted, const hands::JointValues& angles, bool is_fading,
                                       const Fade& fade, double dt, LimitReasons& reasons) noexcept {
  if (stiffness_ <= 0.0) return last_;
  observe_rates(angles, dt);
  is_fading ? remember() : settle_fade(angles);
  newest_angles_ = angles;
  const bool are_resting = resting_for_s_ > kEnvelope.rested_s;
  const double refill_W = are_resting ? kEnvelope.limits_rest_refill_W : kEnvelope.limits_refill_W;
  energy_ += refill_W * dt;
  JointLimits next;
  next.expiry = expiry_;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    JointLimit& limit = next.joints[j];
    const JointLimit& last = last_.joints[j];
    if (is_fading) {
      limit = last;
      limit.max_torque = std::max(0.0, last.max_torque - dt / fade_s_ * descriptor_.max_joint_torque);
      if (limit.max_torque == 0.0) limit = {};
      continue;
    }
    limit = within_device(j, wanted.joints[j], reasons);
    limit.max_torque *= fade.gain();
    if (is_absent(limit)) limit = {};
    if (tighten(limit, last, angles[j], dt)) reasons.rate_limited = true;
  }
  if (!is_fading && pay(angles, next, dt)) reasons.energy_limited = true;
  energy_ =
      std::min(energy_, std::max(kEnvelope.limits_start_J, kEnvelope.limits_most_rad * descriptor_.max_joint_torque));
  last_ = next;
  return last_;
}

/// Steps of an angle sensor are no motion: a joint moves when it leaves a play of one step.
void FingerLimits::observe_rates(const hands::JointValues& angles, double dt) noexcept {
  if (dt <= 0.0) return;
  const double share = std::min(1.0, dt / kEnvelope.rate_averaged_s);
  const double play = descriptor_.joint_resolution;
  double fastest = 0.0;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    const double way = std::clamp(last_angles_[j], angles[j] - play, angles[j] + play) - last_angles_[j];
    last_angles_[j] += way;
    rates_[j] += share * (way / dt - rates_[j]);
    fastest = std::max(fastest, std::abs(rates_[j]));
  }
  resting_for_s_ = fastest < kEnvelope.resting_rad_per_s ? resting_for_s_ + dt : 0.0;
}

JointLimit FingerLimits::within_device(std::size_t joint, const JointLimit& wanted,
                                       LimitReasons& reasons) const noexcept {
  JointLimit limit = wanted;
  if (is_absent(limit) || limit.lower > limit.upper || descriptor_.undriven_joints[joint]) return {};
  if (limit.max_torque > descriptor_.max_joint_torque) reasons.joints_limited = true;
  limit.max_torque = std::min(limit.max_torque, descriptor_.max_joint_torque);
  limit.stiffness = std::min(limit.stiffness, stiffness_);
  limit.damping = std::clamp(limit.damping, 0.0, passive_limit_damping(descriptor_, limit.stiffness));
  return limit;
}

/// So that the torque on the finger where it is now rises no faster than the device's rate. A limit that opens, does so
/// at once: a torque that vanishes pushes nobody. Returns whether the limit tightens less than wanted.
bool FingerLimits::tighten(JointLimit& limit, const JointLimit& last, double angle, double dt) const noexcept {
  const double before = limit_torque(last, angle, 0.0);
  const double wanted_torque = limit_torque(limit, angle, 0.0);
  const bool turns = before * wanted_torque < 0.0;
  const double most = (turns ? 0.0 : std::abs(before)) + torque_rate_ * dt;
  if (is_absent(limit) || std::abs(wanted_torque) <= most) return false;
  const JointLimit wanted = limit;
  // Where the spring gives just that torque; but no farther out than the limit that the finger has felt.
  const double excess = most / limit.stiffness;
  if (angle > limit.upper) limit.upper = std::max(limit.upper, std::min(last.upper, angle - excess));
  if (angle < limit.lower) limit.lower = std::min(limit.lower, std::max(last.lower, angle + excess));
  // A limit that stays where it was, and may push harder.
  if (std::abs(limit_torque(limit, angle, 0.0)) > most) limit.max_torque = std::min(limit.max_torque, most);
  return limit != wanted;
}

bool FingerLimits::drop() noexcept {
  if (!last_.any()) return false;
  remember();
  last_ = {};
  last_.expiry = expiry_;
  return true;
}

/// Where the fingers were before the limits began to fade, and what limits they had.
void FingerLimits::remember() noexcept {
  if (before_fade_) return;
  before_fade_ = last_;
  angles_before_fade_ = newest_angles_;
}

/// Where the fingers went in the meantime is not known. What is left of the energy that they had put in comes back, as
/// far as the limits have faded.
void FingerLimits::settle_fade(const hands::JointValues& angles) noexcept {
  if (!before_fade_) return;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    const JointLimit& before = before_fade_->joints[j];
    const double left = std::min(stored_energy(before, angles_before_fade_[j]), stored_energy(before, angles[j]));
    energy_ += std::max(0.0, left - stored_energy(last_.joints[j], angles[j]));
  }
  before_fade_.reset();
}

/// Books the energy that the springs gain or lose where the fingers are now. If the account does not pay for what they
/// gain, the limits that tighten move only a share of their way. Limits that open, open. Returns whether it was so.
bool FingerLimits::pay(const hands::JointValues& angles, JointLimits& next, double dt) noexcept {
  std::array<bool, hands::kJoints> gains{};
  double wanted = 0.0;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    const double gain = stored_energy(next.joints[j], angles[j]) - stored_energy(last_.joints[j], angles[j]);
    gains[j] = gain > 0.0;
    (gains[j] ? wanted : energy_) += gains[j] ? gain : -gain;
  }
  if (wanted <= energy_) {
    energy_ -= wanted;
    return false;
  }
  const auto share_of = [&](std::size_t j, double share) {
    JointLimit limit = between(last_.joints[j], next.joints[j], share);
    tighten(limit, last_.joints[j], angles[j], dt);  // a limit between two may push harder than both
    return limit;
  };
  const auto gain_of = [&](double share) {
    double gain = 0.0;
    for (std::size_t j = 0; j < hands::kJoints; ++j) {
      if (gains[j])
        gain += std::max(0.0, stored_energy(share_of(j, share), angles[j]) - stored_energy(last_.joints[j], angles[j]));
    }
    return gain;
  };
  double share = 0.0;
  for (double step = 0.5; step > 1e-6; step *= 0.5) {
    if (gain_of(share + step) <= energy_) share += step;
  }
  energy_ = std::max(0.0, energy_ - gain_of(share));
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    if (gains[j]) next.joints[j] = share_of(j, share);
  }
  return true;
}

}  // namespace glissade::devices

/// The passivity observer and controller of the safety envelope: the energy that force and torque may still give.

#include <algorithm>
#include <cmath>

#include <glissade/devices/safety_envelope.h>

#include "envelope/envelope_numbers.h"

namespace glissade::devices {

namespace {

using std::chrono::nanoseconds;

constexpr double kMostEnergy_m = 0.25;  // times the largest force
constexpr double kLeastScale = 0.2;     // where all energy is gone: with less, the hand could give none
constexpr double kScaleFall_s = 0.03;
constexpr double kScaleRise_s = 0.3;
constexpr double kReserve_J = 0.005;     // not given away, because the rates come after this limit
constexpr double kRecovery_W = 0.1;      // without a force, up to the energy at the start
constexpr double kEnergyPeriods = 10.0;  // longer than a fade at the usual rates
constexpr nanoseconds kReturnIsFree = std::chrono::milliseconds(500);
constexpr double kStir_s = 0.5;
constexpr double kMostStirred_J = 0.01;  // from which a contact is not calm
constexpr double kCalmRefill_W = 0.1;

double time_to_zero(const Eigen::Vector3d& vector, double rate) noexcept {
  return vector.isZero(0.0) ? 0.0 : vector.norm() / rate;
}

/// The rotation from A to B as a vector, small angles only.
Eigen::Vector3d turn_between(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) noexcept {
  const Eigen::Matrix3d R = B * A.transpose();
  return 0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

}  // namespace

// The command of a period is given until the next; where states are rare, the motion is shared among the commands.
void SafetyEnvelope::observe_work(const GloveState& state) noexcept {
  if (!has_state_ || summed_ == 0) return;
  const Eigen::Vector3d moved = state.X_WH.translation() - state_.X_WH.translation();
  const Eigen::Vector3d turned = turn_between(state_.X_WH.linear(), state.X_WH.linear());
  const double work = (f_sum_.dot(moved) + t_sum_.dot(turned)) / summed_;
  energy_ = std::min(energy_ - work, most_energy());
  stirred_ += std::abs(work);
}

double SafetyEnvelope::most_energy() const noexcept {
  return std::max(kStartEnergy_J, kMostEnergy_m * descriptor_.max_force);
}

void SafetyEnvelope::take_supply(const GloveCommand& wanted, double dt) noexcept {
  // Another sender counts from another beginning.
  if (supply_sequence_ == 0 || wanted.sequence < supply_sequence_) supply_ = wanted.supply;
  supply_sequence_ = wanted.sequence;
  const double most = descriptor_.max_power * dt;
  const double step = std::clamp(wanted.supply - supply_, -most, most);
  supply_ += step;
  // What was taken stays owed when there is nothing left: the other side has it.
  energy_ = std::clamp(energy_ + step, -most_energy(), most_energy());
  stirred_ += std::abs(step);
}

/// What was given or kept in a contact is settled when there is no force any more. While the force returns from an
/// interruption, in which the hand may have gone anywhere, a refill lifts it; many interruptions use it up. It also
/// pays off slowly what a contact has given too much, e.g. because its contacts vanished for a moment: but only while
/// nothing oscillates.
void SafetyEnvelope::settle_energy(bool has_force, nanoseconds now, double dt) noexcept {
  refill_ = std::min(kMostRefill_J, refill_ + kRecovery_W * dt);
  if (gain_ < 1.0) free_until_ = now + kReturnIsFree;
  stirred_ -= std::min(1.0, dt / kStir_s) * stirred_;
  const double calm = std::max(0.0, 1.0 - stirred_ / kMostStirred_J);
  if (energy_ < kStartEnergy_J) {
    const double most = now < free_until_ ? refill_ : std::min(refill_, calm * kCalmRefill_W * dt);
    const double refilled = std::min(kStartEnergy_J - energy_, most);
    refill_ -= refilled;
    energy_ += refilled;
  }
  if (!has_force) energy_ = std::min(kStartEnergy_J, energy_ + kRecovery_W * dt);
}

// A glove behind a link has an envelope of its own, which knows the motion without delay.
//
// The wrench shrinks smoothly with the energy that is left. A scale that followed the motion would switch on and off: a
// hand at rest must find the same force from tick to tick. What remains to be cut at once is small.
void SafetyEnvelope::limit_energy(Forces& forces, double dt, LimitReasons& reasons) noexcept {
  if (state_.link_delay > nanoseconds(0)) return;
  const double left = std::clamp(energy_ / kStartEnergy_J, 0.0, 1.0);
  const double target = kLeastScale + (1.0 - kLeastScale) * left * left * (3.0 - 2.0 * left);
  energy_scale_ += std::clamp(target - energy_scale_, -dt / kScaleFall_s, dt / kScaleRise_s);
  double scale = energy_scale_;
  // A device whose rates are low goes on giving while its force falls.
  const double ahead_s = std::max(
      {kEnergyPeriods * in_seconds(period_), time_to_zero(last_.f, force_rate_), time_to_zero(last_.t, torque_rate_)});
  const double work = ahead_s * scale * (forces.f.dot(state_.v_WH) + forces.t.dot(state_.w_WH));
  const double available = std::max(0.0, energy_ - kReserve_J);
  if (work > available) scale *= available / work;
  if (scale >= 1.0) return;
  forces.f *= scale;
  forces.t *= scale;
  reasons.energy_limited = true;
}

}  // namespace glissade::devices

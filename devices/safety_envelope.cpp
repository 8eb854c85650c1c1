#include <algorithm>
#include <cmath>

#include <glissade/devices/safety_envelope.h>

namespace glissade::devices {
namespace {

using std::chrono::nanoseconds;

constexpr double kFadePeriods = 7.0;
constexpr double kReturn_s = 0.2;
constexpr double kMeanTime_s = 10.0;
constexpr double kSoftMean = 0.9;  // share of the largest mean from which the force is reduced
constexpr nanoseconds kDistrust = std::chrono::milliseconds(100);
constexpr nanoseconds kLateForGood = std::chrono::seconds(1);
constexpr std::int64_t kDriftShare = 5000;  // clocks may drift apart by one part in so many
constexpr double kJumpTolerance_m = 1e-3;
constexpr double kTurnTolerance = 1e-2;  // rad
constexpr double kSpeedMismatch = 0.5;   // share of the largest speed
constexpr double kStartEnergy_J = 0.1;
constexpr double kMostEnergy_m = 0.25;  // times the largest force
constexpr double kLeastScale = 0.2;     // where all energy is gone: with less, the hand could give none
constexpr double kScaleFall_s = 0.03;
constexpr double kScaleRise_s = 0.3;
constexpr double kReserve_J = 0.005;     // not given away, because the rates come after this limit
constexpr double kMostRefill_J = 1.0;    // for returns and calm contacts; comes back by kRecovery_W
constexpr double kRecovery_W = 0.1;      // without a force, up to the energy at the start
constexpr double kEnergyPeriods = 10.0;  // longer than a fade
constexpr nanoseconds kReturnIsFree = std::chrono::milliseconds(500);
constexpr double kStir_s = 0.5;
constexpr double kMostStirred_J = 0.01;  // from which a contact is not calm
constexpr double kCalmRefill_W = 0.1;
constexpr nanoseconds kHalfSecond = std::chrono::milliseconds(500);
constexpr nanoseconds kLongestDelay = std::chrono::milliseconds(150);

double seconds(nanoseconds time) noexcept {
  return std::chrono::duration<double>(time).count();
}

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

bool all_finite(const JointValues& values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// Sums of times within these bounds cannot overflow.
bool is_finite(nanoseconds time) noexcept {
  constexpr nanoseconds kGreatest(std::int64_t{1} << 61);
  return -kGreatest < time && time < kGreatest;
}

bool is_finite(const GloveCommand& command) noexcept {
  return std::isfinite(command.supply) && is_finite(command.state_time) && command.f_H_W.allFinite() &&
         command.t_H_W.allFinite() && all_finite(command.joint_torques);
}

bool is_finite(const GloveState& state) noexcept {
  return is_finite(state.time) && state.X_WH.matrix().allFinite() && state.v_WH.allFinite() && state.w_WH.allFinite() &&
         all_finite(state.joint_angles);
}

/// The rotation from A to B as a vector, small angles only.
Eigen::Vector3d turn_between(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) noexcept {
  const Eigen::Matrix3d R = B * A.transpose();
  return 0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

double angle_between(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) noexcept {
  const double cosine = 0.5 * ((A.transpose() * B).trace() - 1.0);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double rate_or_default(double rate, double maximum, const DeviceDescriptor& descriptor) noexcept {
  return rate > 0.0 ? rate : maximum * descriptor.update_rate / kFadePeriods;
}

}  // namespace

SafetyEnvelope::SafetyEnvelope(const DeviceDescriptor& descriptor, double patience_periods,
                               nanoseconds period_of_caller)
    : descriptor_(descriptor), energy_(kStartEnergy_J), refill_(kMostRefill_J) {
  validate(descriptor_);
  const auto rounded = [](std::chrono::duration<double> time) { return std::chrono::duration_cast<nanoseconds>(time); };
  period_ = std::max(period_of_caller, rounded(std::chrono::duration<double>(1.0 / descriptor_.update_rate)));
  patience_ = rounded(patience_periods * std::chrono::duration<double>(period_));
  force_rate_ = rate_or_default(descriptor_.max_force_rate, descriptor_.max_force, descriptor_);
  torque_rate_ = rate_or_default(descriptor_.max_torque_rate, descriptor_.max_torque, descriptor_);
  joint_torque_rate_ = rate_or_default(descriptor_.max_joint_torque_rate, descriptor_.max_joint_torque, descriptor_);
}

SafeCommand SafetyEnvelope::limit(const GloveCommand& wanted, const GloveState& newest, nanoseconds now) noexcept {
  const double dt = seconds_since_last_call(now);
  observe(newest, now);

  SafeCommand safe;
  LimitReasons& reasons = safe.reasons_;
  reasons = faults(wanted, newest, now);
  if (!reasons.not_finite) {
    safe.age_ = age_of(wanted.state_time, now);
    observe_delay(safe.age_, now);
  }
  if (is_finite(wanted)) {
    wanted_ = {wanted.f_H_W, wanted.t_H_W, wanted.joint_torques};
    take_supply(wanted, dt);
  }
  const double change = reasons.is_fading() ? -dt / (kFadePeriods * seconds(period_)) : dt / kReturn_s;
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
  settle_energy(!last_.f.isZero(0.0) || !last_.t.isZero(0.0), now, dt);
  limit_energy(forces, dt, reasons);
  limit_rates(forces, dt, reasons);
  // Cannot happen; but NaN would pass all limits above, and stay.
  if (!forces.f.allFinite() || !forces.t.allFinite() || !all_finite(forces.joints)) forces = {};
  // The return begins at zero, however soon the force was there.
  const bool is_zero = forces.f.isZero(0.0) && forces.t.isZero(0.0) && forces.joints == JointValues{};
  if (reasons.is_fading() && is_zero) gain_ = 0.0;
  mean_force_ += std::min(1.0, dt / kMeanTime_s) * (forces.f.norm() - mean_force_);
  last_ = forces;
  f_sum_ += forces.f;
  t_sum_ += forces.t;
  ++summed_;

  safe.energy_ = energy_;
  safe.values_ = wanted;
  safe.values_.f_H_W = forces.f;
  safe.values_.t_H_W = forces.t;
  safe.values_.joint_torques = forces.joints;
  return safe;
}

double SafetyEnvelope::seconds_since_last_call(nanoseconds now) noexcept {
  const nanoseconds passed = has_been_called_ ? now - last_call_ : nanoseconds(0);
  has_been_called_ = true;
  last_call_ = now;
  return seconds(std::clamp(passed, nanoseconds(0), 2 * period_));
}

bool SafetyEnvelope::trusts(const GloveState& newest, nanoseconds now) noexcept {
  observe(newest, now);
  return is_finite(newest) && now >= distrust_until_;
}

void SafetyEnvelope::observe(const GloveState& state, nanoseconds now) noexcept {
  if (!is_finite(state)) {
    distrust_until_ = now + kDistrust;
    return;
  }
  const bool is_new = !has_state_ || state.sequence != state_.sequence || state.time != state_.time;
  if (!is_new) return;
  if (is_plausible(state)) {
    observe_work(state);
  } else {
    distrust_until_ = now + kDistrust;
  }
  f_sum_.setZero();
  t_sum_.setZero();
  summed_ = 0;
  update_offset(state, now);
  const bool repeats = has_state_ && state.X_WH.matrix() == state_.X_WH.matrix();
  if (!repeats) pose_time_ = state.time;
  state_ = state;
  has_state_ = true;
}

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

void SafetyEnvelope::observe_delay(nanoseconds age, nanoseconds now) noexcept {
  if (now - half_second_begin_ >= kHalfSecond) {
    // The first half second is not whole: nothing is known before.
    least_age_before_ = half_second_begin_ == nanoseconds(0) ? nanoseconds(0) : least_age_;
    least_age_ = age;
    half_second_begin_ = now;
  }
  least_age_ = std::max(nanoseconds(0), std::min(least_age_, age));
}

nanoseconds SafetyEnvelope::link_delay() const noexcept {
  const nanoseconds least = std::min(least_age_before_, least_age_);
  return least <= kLongestDelay ? least : nanoseconds(0);
}

nanoseconds SafetyEnvelope::oldest_command() const noexcept {
  const nanoseconds delay = link_delay();
  return delay > patience_ ? delay + patience_ : patience_;
}

bool SafetyEnvelope::is_plausible(const GloveState& state) noexcept {
  if (state.v_WH.norm() > descriptor_.max_speed || state.w_WH.norm() > descriptor_.max_turn_rate) return false;
  if (state.X_WH.translation().norm() > descriptor_.workspace_radius) return false;
  if (!has_state_) return true;  // nothing to compare with
  if (state.time < state_.time) return false;
  if (descriptor_.frozen > nanoseconds(0) && state.X_WH.matrix() == state_.X_WH.matrix() &&
      state.time - pose_time_ > descriptor_.frozen) {
    return false;
  }
  const double dt = seconds(state.time - state_.time);
  const Eigen::Vector3d moved = state.X_WH.translation() - state_.X_WH.translation();
  if (moved.norm() > descriptor_.max_speed * dt + kJumpTolerance_m) return false;
  const double turned = angle_between(state_.X_WH.linear(), state.X_WH.linear());
  if (turned > descriptor_.max_turn_rate * dt + kTurnTolerance) return false;
  const Eigen::Vector3d unexplained = moved - 0.5 * dt * (state.v_WH + state_.v_WH);
  return unexplained.norm() <= kSpeedMismatch * descriptor_.max_speed * dt + kJumpTolerance_m;
}

void SafetyEnvelope::update_offset(const GloveState& state, nanoseconds now) noexcept {
  const nanoseconds difference = now - state.time;
  const bool is_first = !has_state_ || state.time < state_.time;
  // A clock that stands still does not go wrong, it fails.
  const bool is_late_for_good =
      late_since_ && now - *late_since_ > kLateForGood && state.time - late_time_ > kLateForGood / 2;
  if (is_first || is_late_for_good) {
    offset_ = difference;
  } else {
    offset_ = std::min(offset_ + (state.time - state_.time) / kDriftShare, difference);
  }
  if (difference - offset_ <= patience_) {
    late_since_.reset();
  } else if (!late_since_) {
    late_since_ = now;
    late_time_ = state.time;
  }
}

nanoseconds SafetyEnvelope::age_of(nanoseconds measured, nanoseconds now) const noexcept {
  return now - offset_ - measured;
}

LimitReasons SafetyEnvelope::faults(const GloveCommand& wanted, const GloveState& newest,
                                    nanoseconds now) const noexcept {
  LimitReasons reasons;
  reasons.is_stopped = is_stopped_;
  reasons.is_disabled = !newest.is_enabled;
  reasons.is_refused = newest.obeys_another;
  reasons.not_finite = !is_finite(wanted) || !is_finite(newest);
  reasons.is_implausible = now < distrust_until_;
  if (reasons.not_finite) return reasons;  // no ages are known
  reasons.is_state_old = age_of(state_.time, now) > patience_;
  const bool is_from_future = wanted.state_time > state_.time;
  reasons.is_command_old =
      !reasons.is_state_old && (is_from_future || age_of(wanted.state_time, now) > oldest_command());
  return reasons;
}

// Straight to zero, so that a change of the wanted direction cannot make the fade longer.
SafetyEnvelope::Forces SafetyEnvelope::faded(double dt) const noexcept {
  const double share = dt / (kFadePeriods * seconds(period_));
  const auto shorter = [](const Eigen::Vector3d& vector, double by) {
    const double norm = vector.norm();
    return norm > by ? Eigen::Vector3d((1.0 - by / norm) * vector) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  Forces forces{shorter(last_.f, share * descriptor_.max_force), shorter(last_.t, share * descriptor_.max_torque), {}};
  const double by = share * descriptor_.max_joint_torque;
  for (std::size_t i = 0; i < kGloveJoints; ++i)
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
  const double work =
      kEnergyPeriods * seconds(period_) * scale * (forces.f.dot(state_.v_WH) + forces.t.dot(state_.w_WH));
  const double available = std::max(0.0, energy_ - kReserve_J);
  if (work > available) scale *= available / work;
  if (scale >= 1.0) return;
  forces.f *= scale;
  forces.t *= scale;
  reasons.energy_limited = true;
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

void SafetyEnvelope::limit_rates(Forces& forces, double dt, LimitReasons& reasons) const noexcept {
  const bool force_limited = limit_step(forces.f, last_.f, force_rate_ * dt);
  const bool torque_limited = limit_step(forces.t, last_.t, torque_rate_ * dt);
  // The sum above may exceed a limit by rounding.
  limit_norm(forces.f, descriptor_.max_force);
  limit_norm(forces.t, descriptor_.max_torque);
  reasons.rate_limited = force_limited || torque_limited;
  for (std::size_t i = 0; i < kGloveJoints; ++i) {
    const double step = joint_torque_rate_ * dt;
    const double limited = std::clamp(forces.joints[i], last_.joints[i] - step, last_.joints[i] + step);
    reasons.rate_limited = reasons.rate_limited || limited != forces.joints[i];
    forces.joints[i] = limited;
  }
}

namespace {

std::string age_text(nanoseconds age) {
  if (age > std::chrono::seconds(10)) return "more than 10 s old";
  if (age >= std::chrono::milliseconds(10)) return std::to_string(age / std::chrono::milliseconds(1)) + " ms old";
  const std::int64_t tenths = age / std::chrono::microseconds(100);
  return std::to_string(tenths / 10) + "." + std::to_string(std::abs(tenths % 10)) + " ms old";
}

}  // namespace

std::string to_text(const LimitReasons& reasons, nanoseconds age) {
  const std::string old = age_text(age);
  if (reasons.is_stopped) return "no force: it was stopped for good";
  if (reasons.is_disabled) return "no force: the wearer does not hold the enable switch";
  if (reasons.is_refused) return "no force: the glove obeys another server";
  if (reasons.not_finite) return "no force: a number of the glove's state or of the command is not finite";
  if (reasons.is_implausible) return "no force: the glove's pose jumps or freezes or leaves the workspace";
  if (reasons.is_state_old) return "no force: the glove's state is " + old;
  if (reasons.is_command_old && age < nanoseconds(0)) return "no force: the command answers a state that never was";
  if (reasons.is_command_old) return "no force: the command answers a state that is " + old;
  if (reasons.is_returning) return "reduced force: it returns softly";
  if (reasons.mean_limited) return "reduced force: its mean is near the device's limit";
  if (reasons.energy_limited) return "reduced force: it has given back all energy that the hand put in";
  if (reasons.power_limited) return "reduced force: its power is at the device's limit";
  if (reasons.force_limited || reasons.torque_limited || reasons.joints_limited) {
    return "reduced force: it is at the device's limit";
  }
  if (reasons.rate_limited) return "reduced force: it changes as fast as the device's limit allows";
  return {};
}

}  // namespace glissade::devices

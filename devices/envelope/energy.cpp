/// The passivity observer and controller of the safety envelope: the energy that force and torque may still give.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <glissade/devices/safety_envelope.h>

#include "envelope/envelope_numbers.h"
#include "envelope/given_wrenches.h"

namespace glissade::devices {

namespace {

using std::chrono::nanoseconds;

constexpr double kMostEnergy_m = 0.25;  // times the largest force
// The wrench goes on for so long a way before it falls: so it comes back from zero without a jump.
constexpr double kSpare_m = 1e-3;
constexpr double kSpare_rad = 0.01;
constexpr double kRecovery_W = 0.3;
constexpr double kRefill_W = 0.25;       // of the 0.3 W that are promised: the rest is for ways that are not measured
constexpr double kEnergyPeriods = 10.0;  // longer than a fade at the usual rates
constexpr nanoseconds kReturnIsFree = std::chrono::milliseconds(500);
constexpr double kStir_s = 0.5;
constexpr double kMostStirred_J = 0.01;  // to and fro, from which a contact is not calm
constexpr double kCalmRefill_W = 0.5;
constexpr double kMostGiven_J = 0.1;
constexpr double kTremblingRefill_W = 0.15;
constexpr double kMeanSpeed_s = 0.03;
constexpr double kRestingSpeed_m_per_s = 0.03;
constexpr double kRestingTurnRate = 0.5;  // rad/s
constexpr nanoseconds kRested = std::chrono::milliseconds(500);
constexpr double kForgotten_s = 1.0;
constexpr double kUsualResolution_m = 30e-6;  // of a device that does not tell
constexpr double kPlayPerResolution = 4.0;    // noise of this standard deviation hardly ever leaves it
constexpr double kPlayLever_m = 0.1;          // rotations count by the way at this distance

double time_to_zero(const Eigen::Vector3d& vector, double rate) noexcept {
  return vector.isZero(0.0) ? 0.0 : vector.norm() / rate;
}

/// What of the vector is longer than `play`.
Eigen::Vector3d beyond(double play, const Eigen::Vector3d& vector) noexcept {
  const double length = vector.norm();
  return length > play ? Eigen::Vector3d((1.0 - play / length) * vector) : Eigen::Vector3d(0.0, 0.0, 0.0);
}

/// The rotation from A to B as a vector, small angles only.
Eigen::Vector3d turn_between(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) noexcept {
  const Eigen::Matrix3d R = B * A.transpose();
  return 0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

}  // namespace

/// The work since the state up to which it is booked. What the hand did in between is taken as the cubic curve through
/// both poses with both velocities: where states stay away, the force is gone after a few periods of a long way. How
/// the hand really went there is not known, so it has put in nothing.
void SafetyEnvelope::observe_work(const GloveState& state, nanoseconds begin, nanoseconds end) noexcept {
  // The glove's clock may have been set: the caller's time is the upper bound.
  const double seconds = std::min(in_seconds(state.time - booked_.time), in_seconds(end - begin));
  const auto curve = [seconds](const Eigen::Vector3d& way, const Eigen::Vector3d& v_begin,
                               const Eigen::Vector3d& v_end) {
    return [=](double u) {
      return Eigen::Vector3d(u * u * (3.0 - 2.0 * u) * way +
                             seconds * u * (1.0 - u) * ((1.0 - u) * v_begin - u * v_end));
    };
  };
  const Eigen::Vector3d way = state.X_WH.translation() - booked_.X_WH.translation();
  const Eigen::Vector3d turn = turn_between(booked_.X_WH.linear(), state.X_WH.linear());
  const double given =
      given_->work(begin, end, curve(way, booked_.v_WH, state.v_WH), curve(turn, booked_.w_WH, state.w_WH));
  const bool is_known = end - begin <= std::max<nanoseconds>(patience_, kExertedWithoutCommand);
  book(is_known ? -given : std::min(0.0, -given));

  observe_strokes(state, begin, end, seconds);
  given_->forget_until(end);
}

/// Noise of the tracker is neither a stroke nor motion: what counts is the motion of a pose that follows the measured
/// one with a play.
void SafetyEnvelope::observe_strokes(const GloveState& state, nanoseconds begin, nanoseconds end,
                                     double seconds) noexcept {
  const double play = kPlayPerResolution * (descriptor_.resolution > 0.0 ? descriptor_.resolution : kUsualResolution_m);
  const Eigen::Vector3d way = beyond(play, state.X_WH.translation() - X_WH_in_play_.translation());
  const Eigen::Vector3d turn = beyond(play / kPlayLever_m, turn_between(X_WH_in_play_.linear(), state.X_WH.linear()));
  X_WH_in_play_.translation() += way;
  if (!turn.isZero(0.0)) {
    X_WH_in_play_.linear() =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * X_WH_in_play_.linear();
  }
  const double given = given_->work(
      begin, end, [&](double u) { return Eigen::Vector3d(u * way); },
      [&](double u) { return Eigen::Vector3d(u * turn); });
  // No more than that counts, so that a contact is calm soon after a great stroke.
  double& stirred = given < 0.0 ? came_ : went_;
  stirred = std::min(stirred + std::abs(given), kMostStirred_J);
  const double share = std::min(1.0, seconds / kMeanSpeed_s);
  v_in_play_ += share * (way / seconds - v_in_play_);
  w_in_play_ += share * (turn / seconds - w_in_play_);
  const bool moves = std::abs(v_in_play_.dot(wanted_.f.normalized())) > kRestingSpeed_m_per_s ||
                     std::abs(w_in_play_.dot(wanted_.t.normalized())) > kRestingTurnRate;
  if (moves) moves_until_ = end + kRested;
}

void SafetyEnvelope::book(double change) noexcept {
  energy_ = std::min(energy_ + change, most_energy());
  // Both bounds let old strokes be forgotten soon. Energy given to the hand is remembered for longer than energy put
  // in.
  balance_ = std::clamp(balance_ + change, -kMostGiven_J, kMostStirred_J);
}

double SafetyEnvelope::most_energy() const noexcept {
  return std::max(kStartEnergy_J, kMostEnergy_m * descriptor_.max_force);
}

void SafetyEnvelope::take_supply(const GloveCommand& wanted, bool is_fading, double dt) noexcept {
  // Another sender counts from another beginning, and so does one that was not heard for a while.
  const bool goes_on = told_supply_ && wanted.session == told_session_ && wanted.sequence >= told_sequence_;
  double change = goes_on ? std::clamp(wanted.supply - *told_supply_, -most_energy(), most_energy()) : 0.0;
  // What pushed with a force that was cut has done so much less.
  if (change > 0.0) change = std::min(exerted_ * change, descriptor_.max_power * dt);
  if (!goes_on) owed_ = taken_ = 0.0;
  told_supply_ = is_fading ? std::nullopt : std::optional(wanted.supply);
  told_sequence_ = wanted.sequence;
  told_session_ = wanted.session;

  supply_ += change;
  owed_ -= change;
  // What comes from others is no stroke of the hand, and its contact stays calm.
  if (owed_ < 0.0) energy_ = std::min(energy_ - std::exchange(owed_, 0.0), most_energy());
  const double taken = std::clamp(energy_ - enough_, 0.0, owed_);
  energy_ -= taken;
  taken_ += taken;
  owed_ = (owed_ - taken) * (1.0 - std::min(1.0, dt / kForgotten_s));
}

/// Force and torque count by their largest values.
void SafetyEnvelope::observe_share(const Forces& exerted) noexcept {
  const auto weight = [](double largest) { return largest > 0.0 ? 1.0 / (largest * largest) : 0.0; };
  const double of_f = weight(descriptor_.max_force);
  const double of_t = weight(descriptor_.max_torque);
  const double given = of_f * exerted.f.dot(wanted_.f) + of_t * exerted.t.dot(wanted_.t);
  const double whole = of_f * wanted_.f.squaredNorm() + of_t * wanted_.t.squaredNorm();
  exerted_ = whole > 0.0 && std::isfinite(whole) ? std::clamp(given / whole, 0.0, 1.0) : 0.0;
}

/// What was given or kept in a contact is settled when there is no force any more. While the force returns from an
/// interruption, in which the hand may have gone anywhere, a refill lifts it; many interruptions use it up. It also
/// pays off slowly what a contact has given too much, e.g. because its contacts vanished for a moment: but only while
/// nothing oscillates.
void SafetyEnvelope::settle_energy(const Forces& forces, nanoseconds now, double dt) noexcept {
  const auto is_none = [](const Forces& some) { return some.f.isZero(0.0) && some.t.isZero(0.0); };
  const bool has_contact = !is_none(last_) || !is_none(forces);
  enough_ = has_contact ? std::max(kStartEnergy_J, spare(forces) + work_of_fall(forces)) : kStartEnergy_J;
  refill_ = std::min(kMostRefill_J, refill_ + kRefill_W * dt);
  if (gain_ < 1.0) free_until_ = now + kReturnIsFree;
  const double kept = 1.0 - std::min(1.0, dt / kStir_s);
  came_ *= kept;
  went_ *= kept;
  balance_ *= kept;
  // A force that comes back and slowly moves the hand is no oscillation.
  const bool rests = now >= moves_until_;
  const double calm = rests ? std::max(0.0, 1.0 - 2.0 * std::min(came_, went_) / kMostStirred_J) : 0.0;
  if (energy_ < enough_) {
    // A hand that rests trembles, and puts in what it gets; an oscillation that feeds on the device gets more.
    const double trembling = rests && balance_ > 0.0 ? kTremblingRefill_W : 0.0;
    const double recovery = has_contact ? std::max(calm * kCalmRefill_W, trembling) : kRecovery_W;
    const double most = now < free_until_ ? refill_ : std::min(refill_, recovery * dt);
    const double refilled = std::min(enough_ - energy_, most);
    refill_ -= refilled;
    energy_ += refilled;
  }
  if (!has_contact) energy_ = std::min(kStartEnergy_J, energy_);
}

// A glove behind a link has an envelope of its own, which knows the motion without delay.
//
// What is given is a share c of the wrench: if it goes on for a while at the present velocity, and then falls as a
// spring's that the device renders passively, it gives just what is left,
//   c · (work of going on) + c² · (work of the fall) = energy left.
// A hand at rest finds the same force from tick to tick, however its velocity trembles: near zero energy the fall alone
// counts, and c goes as the root of the energy, as the force of a spring does.
void SafetyEnvelope::limit_energy(Forces& forces, LimitReasons& reasons) noexcept {
  if (state_.link_delay > nanoseconds(0)) return;
  const double fall = work_of_fall(forces);
  // A device whose rates are low goes on giving while its force falls.
  // What it has been given and does not exert yet is not counted yet.
  const double ahead_s = in_seconds(descriptor_.delay) +
                         std::max({kEnergyPeriods * in_seconds(period_), time_to_zero(last_.f, force_rate_),
                                   time_to_zero(last_.t, torque_rate_)});
  const double going_on =
      spare(forces) + ahead_s * std::max(0.0, forces.f.dot(state_.v_WH) + forces.t.dot(state_.w_WH));
  const double under_way = std::max(0.0, given_->work_to_come(last_call_, state_.v_WH, state_.w_WH));
  const double available = std::max(0.0, energy_ - under_way);
  const double root = going_on + std::sqrt(going_on * going_on + 4.0 * fall * available);
  const double share = available > 0.0 ? std::min(1.0, 2.0 * available / root) : 0.0;
  if (share >= 1.0) return;
  forces.f *= share;
  forces.t *= share;
  reasons.energy_limited = true;
}

double SafetyEnvelope::spare(const Forces& forces) noexcept {
  return kSpare_m * forces.f.norm() + kSpare_rad * forces.t.norm();
}

/// A law by which the force goes as the root of an energy is a spring itself, and must be passive, too.
double SafetyEnvelope::work_of_fall(const Forces& forces) const noexcept {
  const auto stored = [](const Eigen::Vector3d& vector, double stiffness) {
    return stiffness > 0.0 ? 0.5 * vector.squaredNorm() / stiffness : 0.0;
  };
  return stored(forces.f, stiffness_) + stored(forces.t, rotational_stiffness_);
}

}  // namespace glissade::devices

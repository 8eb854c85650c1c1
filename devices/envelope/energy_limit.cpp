#include "envelope/energy_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "envelope/envelope_numbers.h"
#include "envelope/envelope_settings.h"

namespace glissade::devices {

using std::chrono::nanoseconds;

EnergyLimit::EnergyLimit(const DeviceDescriptor& descriptor, const RateLimit& rates, nanoseconds period,
                         nanoseconds patience)
    : descriptor_(descriptor),
      rates_(rates),
      longest_known_(std::max<nanoseconds>(patience, kEnvelope.exerted_without_command)),
      period_s_(in_seconds(period)),
      given_(descriptor.delay, std::max<nanoseconds>(kEnvelope.exerted_without_command, 2 * period),
             std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(1.0 / descriptor.update_rate))),
      strokes_(descriptor.resolution, descriptor.max_force),
      refill_(kEnvelope.most_refill_J) {
  const double lag = tool_lag(descriptor, period, nanoseconds(0));
  const double own_lag = tool_lag(descriptor, nanoseconds(0), nanoseconds(0));
  const auto passive = [&](double damping, double largest) {
    return std::min(largest, passive_limit(damping, largest, own_lag, lag));
  };
  stiffness_ = passive(descriptor.damping, descriptor.max_stiffness);
  rotational_stiffness_ = passive(descriptor.rotational_damping, descriptor.max_rotational_stiffness);
}

/// What the hand did between two states is taken as the cubic curve through both poses with both velocities: where
/// states stay away, the force is gone after a few periods of a long way. How the hand really went there is not known,
/// so it has put in nothing.
void EnergyLimit::observe(const BookedMotion& motion) noexcept {
  const GloveState& from = motion.from;
  const GloveState& to = motion.to;
  // The glove's clock may have been set: the caller's time is the upper bound.
  const double seconds = std::min(in_seconds(to.time - from.time), in_seconds(motion.end - motion.begin));
  const auto curve = [seconds](const Eigen::Vector3d& way, const Eigen::Vector3d& v_begin,
                               const Eigen::Vector3d& v_end) {
    return [=](double u) {
      return Eigen::Vector3d(u * u * (3.0 - 2.0 * u) * way +
                             seconds * u * (1.0 - u) * ((1.0 - u) * v_begin - u * v_end));
    };
  };
  const geometry::Displacement moved = geometry::displacement_between(from.X_WH, to.X_WH, Eigen::Vector3d::Zero());
  const double given =
      given_.work(motion.begin, motion.end, curve(moved.v, from.v_WH, to.v_WH), curve(moved.w, from.w_WH, to.w_WH));
  const bool is_known = motion.end - motion.begin <= longest_known_;
  book(is_known ? -given : std::min(0.0, -given), motion.is_jump, motion.end);
  strokes_.observe(motion, given_);
  given_.forget_until(motion.end);
}

/// A jump may have been an error of the tracker, for which the hand shall not wait for its force for long: but not of a
/// tracker that stands still again and again.
void EnergyLimit::book(double change, bool is_jump, nanoseconds now) noexcept {
  const double before = energy_;
  energy_ = std::min(energy_ + change, most());
  if (!is_jump) return;
  energy_ = std::min(energy_, before);
  const double least = std::min(before, -kEnvelope.most_debt_J);
  if (energy_ >= least || now < forgives_from_) return;
  energy_ = least;
  forgives_from_ = now + kEnvelope.forgives_again;
}

/// What a hand stores that presses a spring which the device renders passively, at least.
double EnergyLimit::most() const noexcept {
  Forces greatest;
  greatest.f.x() = descriptor_.max_force;
  greatest.t.x() = descriptor_.max_torque;
  const double pressed = work_of_last_way(greatest) + work_of_fall(greatest);
  return std::max({kEnvelope.start_energy_J, kEnvelope.most_energy_m * descriptor_.max_force, pressed});
}

void EnergyLimit::take_supply(const GloveCommand& wanted, bool is_fading, double dt) noexcept {
  // What comes from others is no stroke of the hand, and its contact stays calm.
  energy_ = std::min(energy_ + supply_.take(wanted, is_fading, most(), descriptor_.max_power, dt), most());
  energy_ -= supply_.give_up(energy_ - enough_, dt);
}

/// While the force returns from an interruption, in which the hand may have gone anywhere, a refill lifts it; many
/// interruptions use it up. It also pays off slowly what a contact has given too much, e.g. because its contacts
/// vanished for a moment: but only while nothing oscillates, whether the hand seems to put in more than it gets or not.
/// In each stroke of an oscillation, it does so for a while.
void EnergyLimit::settle(const Forces& forces, const HeldEnergy& held, bool returns, nanoseconds now,
                         double dt) noexcept {
  const bool has_contact = has_force_ || forces.has_wrench() || held.presses;
  energy_ += held.returned;
  enough_ = kEnvelope.start_energy_J;
  if (has_contact) {
    const double needed = work_of_last_way(forces) + work_of_fall(forces) + std::max(0.0, held.gain);
    enough_ = std::clamp(needed, kEnvelope.start_energy_J, most());
  }
  refill_ = std::min(kEnvelope.most_refill_J, refill_ + kEnvelope.refill_W * dt);
  if (returns) free_until_ = now + kEnvelope.return_is_free;
  strokes_.forget(dt);
  if (energy_ < enough_) {
    const double recovery = recovery_W(has_contact, held);
    const double most = now < free_until_ ? refill_ : std::min(refill_, recovery * dt);
    const double refilled = std::min(enough_ - energy_, most);
    refill_ -= refilled;
    energy_ += refilled;
  }
  if (!has_contact) energy_ = std::min(kEnvelope.start_energy_J, energy_);
}

/// Half-spaces that push a hand, and open before it comes back, only give energy. So what they lack recovers while the
/// hand rests.
double EnergyLimit::recovery_W(bool has_contact, const HeldEnergy& held) const noexcept {
  if (descriptor_.tool_command == ToolCommand::kHalfSpaces)
    return held.rests ? kEnvelope.calm_refill_W : kEnvelope.limits_refill_W;
  return has_contact ? strokes_.calm() * kEnvelope.calm_refill_W : kEnvelope.recovery_W;
}

double EnergyLimit::available(const GloveState& state) const noexcept {
  if (state.link_delay > nanoseconds(0)) return std::numeric_limits<double>::infinity();
  return std::max(0.0, energy_);
}

void EnergyLimit::pay(double gain, const GloveState& state) noexcept {
  if (state.link_delay == nanoseconds(0)) energy_ = std::min(energy_ - gain, most());
}

// A glove behind a link has an envelope of its own, which knows the motion without delay.
//
// What is given is a share c of the wrench: if it goes on for a while at the present velocity, and then falls as a
// spring's that the device renders passively, it gives just what is left,
//   c · (power · time of going on) + (work of the last way of c times the wrench) + c² · (work of the fall) = energy
//   left.
// A hand at rest finds the same force from tick to tick, however its velocity trembles: near zero energy the fall alone
// counts, and c goes as the root of the energy, as the force of a spring does.
void EnergyLimit::limit(Forces& forces, const GloveState& state, const Forces& last, nanoseconds now, double dt,
                        LimitReasons& reasons) noexcept {
  if (state.link_delay > nanoseconds(0)) {
    power_ = 0.0;
    return;
  }
  const double fall = work_of_fall(forces);
  // A device whose rates are low goes on giving while its force falls.
  const double ahead_s =
      in_seconds(descriptor_.delay) + std::max(kEnvelope.ahead_periods * period_s_, rates_.time_to_zero(last));
  // A brake that follows each change of the velocity would itself shake a light hand at a slow device. A hand that has
  // left a contact fast may come back before a late device has let go: its power is remembered in free space, too.
  power_ *= std::exp(-dt / (kEnvelope.held_power * ahead_s));
  if (!reasons.is_implausible) power_ = std::max(power_, forces.f.dot(state.v_WH) + forces.t.dot(state.w_WH));
  // What the device has been given and does not exert yet is not counted yet.
  const double under_way = std::max(0.0, given_.work_to_come(now, state.v_WH, state.w_WH));
  const double available = std::max(0.0, energy_ - under_way);
  const auto work_of = [&](double share) {
    Forces given = forces;
    given.scale_wrench(share);
    return share * ahead_s * power_ + work_of_last_way(given) + share * share * fall;
  };
  if (!forces.has_wrench() || work_of(1.0) <= available) return;
  double share = 0.0;
  for (double step = 0.5; step > 1e-12; step *= 0.5) {
    if (work_of(share + step) <= available) share += step;
  }
  forces.scale_wrench(share);
  reasons.energy_limited = true;
}

/// On the way that a hand gains which leaves now, while the device's rates bring its wrench to zero: the distance
/// a t² / 2, weighted with the force that is left.
double EnergyLimit::work_of_last_way(const Forces& forces) const noexcept {
  const double fall = rates_.time_to_zero(forces);
  const double gained = kEnvelope.leaving_m_per_s2 * fall * fall / 6.0;
  return std::max(kEnvelope.spare_m, gained) * (forces.f.norm() + forces.t.norm() / kEnvelope.lever_m);
}

/// A law by which the force goes as the root of an energy is a spring itself, and must be passive, too.
double EnergyLimit::work_of_fall(const Forces& forces) const noexcept {
  const auto stored = [](const Eigen::Vector3d& vector, double stiffness) {
    return stiffness > 0.0 ? 0.5 * vector.squaredNorm() / stiffness : 0.0;
  };
  return stored(forces.f, stiffness_) + stored(forces.t, rotational_stiffness_);
}

void EnergyLimit::observe_given(const Forces& given, nanoseconds now) noexcept {
  given_.give(now, given.f, given.t);
  has_force_ = given.has_wrench();
}

}  // namespace glissade::devices

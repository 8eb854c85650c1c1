#pragma once

/// The passivity observer and controller: the energy that force and torque may still give.

#include <algorithm>
#include <chrono>

#include "envelope/envelope_settings.h"
#include "envelope/forces.h"
#include "envelope/given_wrenches.h"
#include "envelope/half_space_limits.h"
#include "envelope/simple_limits.h"
#include "envelope/state_check.h"
#include "envelope/strokes.h"
#include "envelope/supply.h"

namespace glissade::devices {

class EnergyLimit {
 public:
  /// `patience`: a hand whose states stay away for longer is not taken to have put in anything.
  EnergyLimit(const DeviceDescriptor& descriptor, const RateLimit& rates, std::chrono::nanoseconds period,
              std::chrono::nanoseconds patience);

  /// Counts the work of a motion.
  void observe(const BookedMotion& motion) noexcept;

  void take_supply(const GloveCommand& wanted, bool is_fading, double dt) noexcept;

  /// What was given or kept in a contact is settled when there is no force any more; what is missing recovers. `forces`
  /// are wanted in this period, and so are half-spaces with the energy `held`. `returns`: after an interruption.
  void settle(const Forces& forces, const HeldEnergy& held, bool returns, std::chrono::nanoseconds now,
              double dt) noexcept;

  /// What the spring of half-spaces may gain (J). A glove behind a link has an account of its own.
  double available(const GloveState& state) const noexcept;
  /// Pays for what the spring gains, or takes what it loses.
  void pay(double gain, const GloveState& state) noexcept;

  /// `last`: what the device was given, and what its rates bring to zero.
  void limit(Forces& forces, const GloveState& state, const Forces& last, std::chrono::nanoseconds now, double dt,
             LimitReasons& reasons) noexcept;

  /// The wrench of the command, which the device exerts until the next one.
  void observe_given(const Forces& given, std::chrono::nanoseconds now) noexcept;
  /// What the hand feels of this command, and what it would feel of the wanted one.
  void observe_felt(const Forces& wanted, const Forces& given) noexcept {
    supply_.observe_given(wanted, given, descriptor_);
  }

  double energy() const noexcept { return energy_; }  ///< J
  const Supply& supply() const noexcept { return supply_; }

 private:
  double most() const noexcept;
  double recovery_W(bool has_contact, const HeldEnergy& held) const noexcept;
  double work_of_last_way(const Forces& forces) const noexcept;
  double work_of_fall(const Forces& forces) const noexcept;
  void book(double change, bool is_jump, std::chrono::nanoseconds now) noexcept;

  const DeviceDescriptor& descriptor_;
  const RateLimit& rates_;
  std::chrono::nanoseconds longest_known_;  // between two states
  double period_s_;
  double stiffness_;             // N/m, which the device renders passively
  double rotational_stiffness_;  // Nm/rad
  GivenWrenches given_;
  Strokes strokes_;
  Supply supply_;
  double energy_ = kEnvelope.start_energy_J;
  double enough_ = kEnvelope.start_energy_J;   // J, with which the wanted wrench is whole
  double refill_;                              // J, for all that recovers
  double power_ = 0.0;                         // W, the greatest of late that the wanted wrench would have had
  bool has_force_ = false;                     // by the last command
  std::chrono::nanoseconds free_until_{0};     // up to then the force returns, and the refill pays for its work
  std::chrono::nanoseconds forgives_from_{0};  // what a jump may cost
};

}  // namespace glissade::devices

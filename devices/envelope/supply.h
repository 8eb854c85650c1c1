#pragma once

/// What others give to a hand and ask of it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "envelope/envelope_settings.h"
#include "envelope/forces.h"

namespace glissade::devices {

/// The account of `GloveCommand::supply`: energy in J.
class Supply {
 public:
  /// What the hand gets by this command: what it was asked for before counts first. `most` bounds a change, and
  /// `max_power` a gain in `dt` seconds.
  double take(const GloveCommand& wanted, bool is_fading, double most, double max_power, double dt) noexcept {
    // Another sender counts from another beginning, and so does one that was not heard for a while.
    const bool goes_on = told_ && wanted.session == session_ && wanted.sequence >= sequence_;
    double change = goes_on ? std::clamp(wanted.supply - *told_, -most, most) : 0.0;
    // What pushed with a force that was cut has done so much less.
    if (change > 0.0) change = std::min(exerted_ * change, max_power * dt);
    if (!goes_on) owed_ = taken_ = 0.0;
    told_ = is_fading ? std::nullopt : std::optional(wanted.supply);
    sequence_ = wanted.sequence;
    session_ = wanted.session;

    total_ += change;
    owed_ -= change;
    if (owed_ >= 0.0) return 0.0;
    const double gained = -owed_;
    owed_ = 0.0;
    return gained;
  }

  /// What the hand gives up of the energy that it can spare. What it does not have is forgotten within some seconds.
  double give_up(double spare, double dt) noexcept {
    const double taken = std::clamp(spare, 0.0, owed_);
    taken_ += taken;
    owed_ = (owed_ - taken) * (1.0 - std::min(1.0, dt / kEnvelope.forgotten_s));
    return taken;
  }

  /// The share of the wanted wrench that was given, where force and torque count by their largest values.
  void observe_given(const Forces& wanted, const Forces& given, const DeviceDescriptor& descriptor) noexcept {
    const auto weight = [](double largest) { return largest > 0.0 ? 1.0 / (largest * largest) : 0.0; };
    const double of_f = weight(descriptor.max_force);
    const double of_t = weight(descriptor.max_torque);
    const double part = of_f * given.f.dot(wanted.f) + of_t * given.t.dot(wanted.t);
    const double whole = of_f * wanted.f.squaredNorm() + of_t * wanted.t.squaredNorm();
    exerted_ = whole > 0.0 && std::isfinite(whole) ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
  }

  double taken() const noexcept { return taken_; }  ///< that the hand gave up since the last interruption
  double total() const noexcept { return total_; }  ///< passed on with the command

 private:
  std::optional<double> told_;  // by the last command; none after an interruption
  std::int64_t sequence_ = 0;   // of that command
  std::int64_t session_ = 0;
  double total_ = 0.0;
  double owed_ = 0.0;  // for which others asked, and which the hand did not have
  double taken_ = 0.0;
  double exerted_ = 0.0;  // share of the wanted wrench in the last command
};

}  // namespace glissade::devices

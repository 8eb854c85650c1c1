#pragma once

#include <algorithm>
#include <chrono>

#include "envelope/envelope_numbers.h"
#include "envelope/envelope_settings.h"

namespace glissade::devices {

/// The delay of a link: the upper quartile of the ages of commands, by steps of a bounded rate that are three times as
/// long upwards as downwards (frugal streaming, Ma, Muthukrishnan and Sandler 2013). The stiffness follows it, so it
/// must not swing while ages scatter: the smallest age does, because one command in many hundred comes early.
class LinkDelay {
 public:
  explicit LinkDelay(double period_s) : period_s_(period_s) {}

  /// `age` of a new command in a call of the envelope, `dt` (seconds) after the last call. While a command stays away,
  /// the one before grows old: that is no delay of the link. If new commands come in one of several calls only, the
  /// delay is followed as much slower.
  void observe(std::chrono::nanoseconds age, double dt) noexcept {
    if (age < std::chrono::nanoseconds(0) || age > kEnvelope.longest_delay) return;  // that is a silence
    const double change = in_seconds(age) - delay_s_;
    const double share = std::min(dt / kEnvelope.delay_follows_s, kEnvelope.lag_change * dt / period_s_);
    const double step = (is_found_ ? 1.0 : kEnvelope.finds_delay) * share * (delay_s_ + 0.5 * period_s_);
    is_found_ = is_found_ || change <= step;
    delay_s_ += std::clamp(change, -step / 3.0, step);
  }

  std::chrono::nanoseconds upper_quartile() const noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(delay_s_));
  }

 private:
  double period_s_;
  double delay_s_ = 0.0;
  bool is_found_ = false;  // it has reached the age of a command
};

}  // namespace glissade::devices

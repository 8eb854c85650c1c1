#pragma once

#include <algorithm>
#include <chrono>

#include "envelope/envelope_settings.h"

namespace glissade::devices {

/// The delay that all commands of the last half second or more had.
class LinkDelay {
 public:
  void observe(std::chrono::nanoseconds age, std::chrono::nanoseconds now) noexcept {
    if (now - begin_ >= kEnvelope.delay_window) {
      // The first half second is not whole: nothing is known before.
      least_before_ = begin_ == std::chrono::nanoseconds(0) ? std::chrono::nanoseconds(0) : least_;
      least_ = age;
      begin_ = now;
    }
    least_ = std::max(std::chrono::nanoseconds(0), std::min(least_, age));
  }

  /// 0 where it would be longer than a link's: that is a silence.
  std::chrono::nanoseconds least() const noexcept {
    const std::chrono::nanoseconds least = std::min(least_before_, least_);
    return least <= kEnvelope.longest_delay ? least : std::chrono::nanoseconds(0);
  }

 private:
  std::chrono::nanoseconds least_before_{0};  // in the last whole half second
  std::chrono::nanoseconds least_{0};         // since then
  std::chrono::nanoseconds begin_{0};         // of the present half second
};

}  // namespace glissade::devices

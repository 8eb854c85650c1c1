#include "envelope/clock_difference.h"

#include <algorithm>

#include "envelope/envelope_settings.h"

namespace glissade::devices {

void ClockDifference::observe(std::chrono::nanoseconds sent, std::chrono::nanoseconds now) noexcept {
  const std::chrono::nanoseconds difference = now - sent;
  const bool is_first = !last_sent_ || sent < *last_sent_;
  // A clock that stands still does not go wrong, it fails.
  const bool is_late_for_good =
      late_since_ && now - *late_since_ > kEnvelope.late_for_good && sent - late_time_ > kEnvelope.late_for_good / 2;
  if (is_first || is_late_for_good) {
    value_ = difference;
  } else {
    value_ = std::min(value_ + (sent - *last_sent_) / kEnvelope.drift_share, difference);
  }
  last_sent_ = sent;
  if (difference - value_ <= patience_) {
    late_since_.reset();
  } else if (!late_since_) {
    late_since_ = now;
    late_time_ = sent;
  }
}

}  // namespace glissade::devices

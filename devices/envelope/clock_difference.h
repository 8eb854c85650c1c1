#pragma once

/// The difference of two clocks, from messages with a time of the sender's clock.

#include <chrono>
#include <optional>

namespace glissade::devices {

/// The fastest message so far gives the difference, which may drift. The difference is determined anew if the sender's
/// clock goes back, or if all messages within a second are late although their times advance.
class ClockDifference {
 public:
  /// A message is late if it takes longer than the fastest one by more than `patience`.
  explicit ClockDifference(std::chrono::nanoseconds patience) : patience_(patience) {}

  /// A message with the time `sent` of the sender has come at `now`.
  void observe(std::chrono::nanoseconds sent, std::chrono::nanoseconds now) noexcept;

  /// The receiver's clock minus the sender's clock; 0 before the first message.
  std::chrono::nanoseconds value() const noexcept { return value_; }

 private:
  std::chrono::nanoseconds patience_;
  std::chrono::nanoseconds value_{0};
  std::optional<std::chrono::nanoseconds> last_sent_;
  std::chrono::nanoseconds late_time_{0};               // the time of that message
  std::optional<std::chrono::nanoseconds> late_since_;  // when the first message came that was late, as all after it
};

}  // namespace glissade::devices

#pragma once

/// Whether the basis of a command is new and plausible: states, clocks and reasons to let the force fade.

#include <chrono>
#include <optional>

#include <glissade/devices/glove_device.h>

#include "envelope/clock_difference.h"

namespace glissade::devices {

/// The hand's motion between two states.
struct BookedMotion {
  GloveState from;
  GloveState to;
  std::chrono::nanoseconds begin;  ///< on the caller's clock
  std::chrono::nanoseconds end;
  bool is_jump;  ///< after a pose that stood still: of the hand, or an error of the tracker
};

class StateCheck {
 public:
  /// `patience` is the greatest age of a state, and that of a command beyond the delay of its link.
  StateCheck(const DeviceDescriptor& descriptor, std::chrono::nanoseconds patience)
      : descriptor_(descriptor), patience_(patience), clock_(patience) {}

  /// Looks at the newest state. Returns the motion whose work is to be counted, if there is one.
  std::optional<BookedMotion> observe(const GloveState& state, std::chrono::nanoseconds now) noexcept;

  /// All but `is_stopped`.
  LimitReasons faults(const GloveCommand& wanted, const GloveState& newest, std::chrono::nanoseconds link_delay,
                      std::chrono::nanoseconds now) const noexcept;

  bool trusts(std::chrono::nanoseconds now) const noexcept { return now >= distrust_until_; }

  /// Time at `now` since a measurement.
  std::chrono::nanoseconds age_of(std::chrono::nanoseconds measured, std::chrono::nanoseconds now) const noexcept {
    return now - clock_.value() - measured;
  }

  /// The newest finite one.
  const GloveState& state() const noexcept { return state_; }

 private:
  bool is_plausible(const GloveState& state) const noexcept;
  bool may_have_gone_to(const GloveState& state) const noexcept;

  const DeviceDescriptor& descriptor_;
  std::chrono::nanoseconds patience_;
  bool has_state_ = false;
  GloveState state_;
  GloveState booked_;                      // up to which its work is booked
  std::chrono::nanoseconds booked_at_{0};  // when it was measured, on the caller's clock
  std::chrono::nanoseconds pose_time_{0};  // since when the pose repeats to the bit
  bool has_caught_up_ = false;             // the last states jumped after poses that repeated
  ClockDifference clock_;                  // of the caller and the glove
  std::chrono::nanoseconds distrust_until_{0};
};

}  // namespace glissade::devices

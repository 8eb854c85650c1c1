#pragma once

/// Why a hand gets no force, or less than the contacts demand.

#include <chrono>
#include <cstddef>
#include <string>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/safety_envelope.h>

namespace glissade::apps {

struct ForceReason {
  /// The most serious first.
  enum class Cause { kNone, kEnvelope, kOldContacts, kGlove, kUnsolved, kLagging, kLimit, kLimitAtGlove };

  Cause cause = Cause::kNone;
  devices::LimitReasons reasons{};  ///< of the envelope here, or of that at the glove
  std::chrono::nanoseconds age{0};  ///< of the command or of the contacts

  /// Whether the force fades, or is withheld, until the reason has gone. A limit only bounds the force.
  bool is_fading() const noexcept { return cause != Cause::kNone && cause < Cause::kLimit; }

  /// A number below `kKinds`. It is the same for reasons that differ in their age alone; 0 without a reason.
  std::size_t kind() const noexcept;
  static constexpr std::size_t kKinds =
      (static_cast<std::size_t>(Cause::kLimitAtGlove) + 1) * (devices::kLimitReasons.size() + 1);
};

/// At a server, after a tick, for the hand with this number. Real-time safe.
ForceReason force_reason(const devices::HapticState& state, std::size_t hand) noexcept;
/// The same for records, which also have the limits that are not worth a sentence while a run goes on: a soft return
/// and the rate. Real-time safe.
ForceReason recorded_reason(const devices::HapticState& state, std::size_t hand) noexcept;
/// At a glove. Real-time safe.
ForceReason force_reason(const devices::SafeCommand& command) noexcept;

/// The reason in plain words, such as "no force: the glove's state is 14 ms old", without a comma, so that a CSV file
/// can hold it; empty without a reason.
std::string to_text(const ForceReason& reason);

}  // namespace glissade::apps

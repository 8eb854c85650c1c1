#pragma once

/// Tells the user in a sentence why the hand gets no force, or less than the contacts demand.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::apps {

class ReasonTeller {
 public:
  /// At a server, in every tick, in the haptic thread, for the hand with this number. Wait-free, no allocation.
  void note(const devices::HapticState& sample, std::size_t hand) noexcept;
  /// At a glove, in every period, in its thread. Wait-free, no allocation.
  void note(const devices::SafeCommand& command) noexcept;

  /// A sentence if the force has faded since the last call and for another reason than was told last. "the force
  /// returns" once after such a sentence; otherwise an empty text. One thread, some times a second.
  std::string news();

 private:
  /// What lets the force fade, the most serious first.
  enum class Cause { kNone, kEnvelope, kOldContacts, kGlove, kUnsolved, kLagging };

  struct Fading {
    Cause cause = Cause::kNone;
    devices::LimitReasons reasons;    // of the envelope here, or of that at the glove
    std::chrono::nanoseconds age{0};  // of the command or of the contacts
  };

  void note(const Fading& fading) noexcept;
  static std::string text(const Fading& fading);

  realtime::TripleBuffer<Fading> fading_;
  std::atomic<bool> is_fading_{false};
  std::optional<std::pair<Cause, std::size_t>> told_;  // with the number of the most serious reason
};

}  // namespace glissade::apps

#pragma once

/// Tells the user in a sentence why the hand gets no force, or less than the contacts demand.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::apps {

class ReasonTeller {
 public:
  /// In every period of the loop, in its thread. `contact_set_age` is that of `HapticState`; 0 at a glove. Wait-free,
  /// no allocation.
  void note(const devices::LimitReasons& reasons, std::chrono::nanoseconds age,
            std::chrono::nanoseconds contact_set_age = std::chrono::nanoseconds(0)) noexcept;

  /// A sentence if the force has faded since the last call and for another reason than was told last: that of
  /// `to_text`, or one about the age of the contacts. "the force returns" once after such a sentence; otherwise an
  /// empty text. One thread, some times a second.
  std::string news();

 private:
  struct Fading {
    devices::LimitReasons reasons;
    std::chrono::nanoseconds age{0};
    std::chrono::nanoseconds contact_set_age{0};
  };

  realtime::TripleBuffer<Fading> fading_;
  std::atomic<bool> is_fading_{false};
  std::optional<std::size_t> told_;  // number of the reason; that of none for old contacts
};

}  // namespace glissade::apps

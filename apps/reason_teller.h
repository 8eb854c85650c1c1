#pragma once

/// Tells the user in a sentence why the hand gets no force.

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
  /// In every period of the loop, in its thread. Wait-free, no allocation.
  void note(const devices::LimitReasons& reasons, std::chrono::nanoseconds age) noexcept;

  /// The sentence of `to_text` if the force has faded since the last call and for another reason than was told last;
  /// "the force returns" once after such a sentence; otherwise an empty text. One thread, some times a second.
  std::string news();

 private:
  struct Fading {
    devices::LimitReasons reasons;
    std::chrono::nanoseconds age{0};
  };

  realtime::TripleBuffer<Fading> fading_;
  std::atomic<bool> is_fading_{false};
  std::optional<std::size_t> told_;  // number of the reason
};

}  // namespace glissade::apps

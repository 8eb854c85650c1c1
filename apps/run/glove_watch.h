#pragma once

/// What a simulated glove tells while its script runs: why its force fades, and a line about its state.

#include <chrono>
#include <string>
#include <vector>

#include <glissade/apps/run/reason_teller.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::apps {

class GloveWatch {
 public:
  /// In every period since the first command of a server, in the glove's thread. Wait-free, no allocation.
  void note(std::chrono::nanoseconds time, const devices::SafeCommand& command) noexcept;

  /// Since the last call, such as "1.234 s: no force: the command answers a state that is 14 ms old", with the time
  /// since the first command. One thread, some times a second.
  std::vector<std::string> events();
  /// Such as "2.5 of 12.0 s of the script: 3.4 N"; empty before the first command. The thread of `events`.
  std::string status(std::chrono::nanoseconds script_time, std::chrono::nanoseconds duration);

 private:
  struct Newest {
    std::chrono::nanoseconds start{0};
    devices::SafeCommand command;
  };

  // The glove's thread.
  Newest noted_;
  bool has_noted_ = false;

  // Shared.
  realtime::TripleBuffer<Newest> newest_;
  ReasonTeller reasons_;

  // The thread that tells.
  bool has_news_ = false;
};

}  // namespace glissade::apps

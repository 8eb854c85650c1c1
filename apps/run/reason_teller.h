#pragma once

/// Tells the user in sentences why the force of a hand fades, when it is back, and which limits bound it.

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/run/force_reason.h>
#include <glissade/realtime/spsc_ring.h>

namespace glissade::apps {

struct TimedSentence {
  std::chrono::nanoseconds time{0};
  std::string text;
};

/// Each sentence has the time at which its reason began. A reason that comes and goes is told once in five seconds, and
/// the return of the force, with the time for which it was away, once it has lasted half a second. A limit is told when
/// it lasts a tenth of a second, after the return of the force before it.
class ReasonTeller {
 public:
  /// In every tick, with times that rise. One thread. Wait-free, no allocation.
  void note(std::chrono::nanoseconds time, const ForceReason& reason) noexcept;

  /// What is to be told since the last call. One thread, some times a second.
  std::vector<TimedSentence> news();

 private:
  struct Change {
    std::chrono::nanoseconds time{0};
    ForceReason reason;
  };

  void tell_present(std::chrono::nanoseconds now, std::vector<TimedSentence>& sentences);

  // The thread that notes.
  std::size_t noted_kind_ = 0;

  // Shared.
  realtime::SpscRing<Change> changes_{1024};
  std::atomic<std::chrono::nanoseconds> noted_time_{std::chrono::nanoseconds(0)};

  // The thread that tells.
  Change present_;
  std::chrono::nanoseconds back_since_{0};  // the force, if it does not fade
  std::chrono::nanoseconds lost_since_{0};  // the force that fades, or whose return is not told yet
  std::optional<std::size_t> told_fade_;    // its kind, until the return is told
  std::array<std::optional<std::chrono::nanoseconds>, ForceReason::kKinds> told_;
};

}  // namespace glissade::apps

#pragma once

/// The filter behind the decoder: admits increasing sequences only, and counts admitted and rejected messages.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>

#include <glissade/devices/lcm_bus.h>

namespace glissade::devices {

enum class MessageError { kNone, kWrongSize, kUndecodable, kNotFinite, kOutOfRange, kOutOfSequence };

/// Thread-safety: `admit` in the receive thread, `statistics` in any.
class LinkMonitor {
 public:
  /// After `restart_silence` without an accepted message, any sequence is accepted: the other end may have been
  /// restarted.
  explicit LinkMonitor(std::chrono::nanoseconds restart_silence) : restart_silence_(restart_silence) {}

  /// Counts a message that was decoded with `error` and `sequence` at `now`; returns whether it may be used.
  bool admit(MessageError error, std::int64_t sequence, std::chrono::nanoseconds now) noexcept;

  LinkStatistics statistics() const noexcept;

 private:
  static constexpr std::size_t kErrors = 6;

  std::chrono::nanoseconds restart_silence_;
  std::chrono::nanoseconds last_time_{0};
  std::int64_t last_sequence_ = -1;
  std::array<std::atomic<std::uint64_t>, kErrors> counts_{};  ///< by MessageError
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace glissade::devices

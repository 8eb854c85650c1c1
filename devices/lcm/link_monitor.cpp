#include "lcm/link_monitor.h"

namespace glissade::devices {

bool LinkMonitor::admit(MessageError error, std::int64_t sequence, std::chrono::nanoseconds now) noexcept {
  if (error == MessageError::kNone && sequence <= last_sequence_) {
    if (now - last_time_ < restart_silence_) {
      error = MessageError::kOutOfSequence;
    } else {
      last_sequence_ = -1;
    }
  }
  counts_[static_cast<std::size_t>(error)].fetch_add(1, std::memory_order_relaxed);
  if (error != MessageError::kNone) return false;
  // Nothing counts as lost before the first message of a sequence: the other end may have started long before.
  if (last_sequence_ >= 0) {
    lost_.fetch_add(static_cast<std::uint64_t>(sequence - last_sequence_ - 1), std::memory_order_relaxed);
  }
  last_sequence_ = sequence;
  last_time_ = now;
  return true;
}

LinkStatistics LinkMonitor::statistics() const noexcept {
  const auto count = [this](MessageError error) {
    return counts_[static_cast<std::size_t>(error)].load(std::memory_order_relaxed);
  };
  return {.accepted = count(MessageError::kNone),
          .wrong_size = count(MessageError::kWrongSize),
          .undecodable = count(MessageError::kUndecodable),
          .not_finite = count(MessageError::kNotFinite),
          .out_of_range = count(MessageError::kOutOfRange),
          .out_of_sequence = count(MessageError::kOutOfSequence),
          .lost = lost_.load(std::memory_order_relaxed)};
}

}  // namespace glissade::devices

#include "lcm/link_monitor.h"

#include <random>

namespace glissade::devices {

bool LinkMonitor::admit(MessageError error, const MessageOrigin& origin, std::chrono::nanoseconds now) noexcept {
  if (error == MessageError::kNone) error = check(origin, now);
  counts_[static_cast<std::size_t>(error)].fetch_add(1, std::memory_order_relaxed);
  if (error != MessageError::kNone) return false;
  // Nothing counts as lost before the first message of a session: the other end may have started long before.
  if (last_sequence_ >= 0) {
    lost_.fetch_add(static_cast<std::uint64_t>(origin.sequence - last_sequence_ - 1), std::memory_order_relaxed);
  }
  last_sequence_ = origin.sequence;
  last_time_.store(now, std::memory_order_relaxed);
  return true;
}

MessageError LinkMonitor::check(const MessageOrigin& origin, std::chrono::nanoseconds now) noexcept {
  const bool is_other = origin.device != device_ || origin.session != session();
  if (last_sequence_ >= 0 && !is_other) {
    constexpr double kBurst = 50.0;  // messages that may be lost or delayed at once, for an instant
    const double elapsed_s = std::chrono::duration<double>(now - last_time_.load(std::memory_order_relaxed)).count();
    const auto advance = static_cast<double>(origin.sequence - last_sequence_);
    return advance > 0.0 && advance <= kBurst + kGreatestRate * elapsed_s ? MessageError::kNone
                                                                          : MessageError::kOutOfSequence;
  }
  if (last_sequence_ >= 0 && now - last_time_.load(std::memory_order_relaxed) < lease_)
    return MessageError::kOtherSender;
  device_ = origin.device;
  session_.store(origin.session, std::memory_order_relaxed);
  last_sequence_ = -1;
  return MessageError::kNone;
}

LinkStatistics LinkMonitor::statistics() const noexcept {
  const auto count = [this](MessageError error) {
    return counts_[static_cast<std::size_t>(error)].load(std::memory_order_relaxed);
  };
  return {.accepted = count(MessageError::kNone),
          .wrong_size = count(MessageError::kWrongSize),
          .undecodable = count(MessageError::kUndecodable),
          .wrong_version = count(MessageError::kWrongVersion),
          .not_finite = count(MessageError::kNotFinite),
          .out_of_range = count(MessageError::kOutOfRange),
          .other_receiver = count(MessageError::kOtherReceiver),
          .other_sender = count(MessageError::kOtherSender),
          .out_of_sequence = count(MessageError::kOutOfSequence),
          .lost = lost_.load(std::memory_order_relaxed)};
}

std::int64_t random_session() {
  std::random_device entropy;
  const std::uint64_t bits = (std::uint64_t{entropy()} << 32) | entropy();
  return static_cast<std::int64_t>(bits >> 2) + 1;
}

}  // namespace glissade::devices

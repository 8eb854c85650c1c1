#include "lcm/link_monitor.h"

#include <algorithm>
#include <random>

namespace glissade::devices {

std::string_view words_of(MessageError error) noexcept {
  switch (error) {
    case MessageError::kWrongSize:
    case MessageError::kUndecodable:
      return "they are not of the type that this program knows";
    case MessageError::kWrongVersion:
      return "they have another version of the type";
    case MessageError::kNotFinite:
      return "a number is not finite";
    default:
      return "a number is out of its range";
  }
}

std::vector<std::string> refusals_of(const LinkStatistics& link) {
  std::vector<std::string> reasons;
  const auto add = [&](std::uint64_t count, MessageError error) {
    if (count > 0) reasons.emplace_back(words_of(error));
  };
  add(link.wrong_size + link.undecodable, MessageError::kWrongSize);
  add(link.wrong_version, MessageError::kWrongVersion);
  add(link.not_finite, MessageError::kNotFinite);
  add(link.out_of_range, MessageError::kOutOfRange);
  return reasons;
}

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
  const std::chrono::nanoseconds silence = now - last_time_.load(std::memory_order_relaxed);
  const bool is_holder = session() != 0 && origin.device == device_ && origin.session == session();
  if (is_holder) return follows(origin.sequence, silence) ? MessageError::kNone : MessageError::kOutOfSequence;
  if (session() != 0 && silence < lease_) return MessageError::kOtherSender;
  grant(origin.device, origin.session, now);
  return MessageError::kNone;
}

bool LinkMonitor::follows(std::int64_t sequence, std::chrono::nanoseconds silence) noexcept {
  const auto advances = [sequence](std::int64_t last, double most) {
    return sequence > last && static_cast<double>(sequence - last) <= most;
  };
  const double saved = budget_ + kGreatestRate * std::chrono::duration<double>(silence).count();
  const double most = std::clamp(saved, 0.0, kGreatestAdvance);
  if (last_sequence_ < 0 || advances(last_sequence_, most)) {
    const double left = most - static_cast<double>(sequence - last_sequence_);
    budget_ = last_sequence_ < 0 ? kBurst : std::min(left, kBurst);
    refused_sequence_ = -1;
    return true;
  }
  const bool is_new_start = silence >= lease_ && refused_sequence_ >= 0 && advances(refused_sequence_, kBurst);
  refused_sequence_ = sequence;
  if (is_new_start) last_sequence_ = -1;
  return is_new_start;
}

void LinkMonitor::grant(std::int64_t device, std::int64_t session, std::chrono::nanoseconds now) noexcept {
  device_ = device;
  session_.store(session, std::memory_order_relaxed);
  last_sequence_ = -1;
  refused_sequence_ = -1;
  budget_ = kBurst;
  last_time_.store(now, std::memory_order_relaxed);
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

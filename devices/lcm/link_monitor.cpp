#include "lcm/link_monitor.h"

#include <algorithm>
#include <array>
#include <cstdio>
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

std::string text_of(const DecodeResult& result) {
  const RefusedField& field = result.field;
  std::string text(words_of(result.error));
  if (field.name.empty()) return text;
  const auto number = [](double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.12g", value);
    return std::string(digits.data());
  };
  text += (field.is_norm ? ": the norm of " : ": ") + std::string(field.name);
  if (field.index >= 0) text += "[" + std::to_string(field.index) + "]";
  return text + " is " + number(field.value) + (field.wanted ? ", not " + number(*field.wanted) : "");
}

std::vector<std::string> refusals_of(const LinkStatistics& link) {
  std::vector<std::string> reasons;
  const auto add = [&](std::uint64_t count, MessageError error, const RefusedField& first) {
    if (count > 0) reasons.push_back(text_of({error, first}));
  };
  add(link.wrong_size + link.undecodable, MessageError::kWrongSize, link.first_wrong_size);
  add(link.wrong_version, MessageError::kWrongVersion, link.first_wrong_version);
  add(link.not_finite, MessageError::kNotFinite, link.first_not_finite);
  add(link.out_of_range, MessageError::kOutOfRange, link.first_out_of_range);
  return reasons;
}

bool LinkMonitor::admit(const DecodeResult& result, const MessageOrigin& origin,
                        std::chrono::nanoseconds now) noexcept {
  const MessageError error = result.error == MessageError::kNone ? check(origin, now) : result.error;
  First& first = firsts_[static_cast<std::size_t>(error)];
  if (!result.field.name.empty() && !first.is_known.load(std::memory_order_relaxed)) {
    first.field = result.field;
    first.is_known.store(true, std::memory_order_release);
  }
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
  const auto first = [this](MessageError error) {
    const First& known = firsts_[static_cast<std::size_t>(error)];
    return known.is_known.load(std::memory_order_acquire) ? known.field : RefusedField{};
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
          .lost = lost_.load(std::memory_order_relaxed),
          .first_wrong_size = first(MessageError::kWrongSize),
          .first_wrong_version = first(MessageError::kWrongVersion),
          .first_not_finite = first(MessageError::kNotFinite),
          .first_out_of_range = first(MessageError::kOutOfRange)};
}

std::int64_t random_session() {
  std::random_device entropy;
  const std::uint64_t bits = (std::uint64_t{entropy()} << 32) | entropy();
  return static_cast<std::int64_t>(bits >> 2) + 1;
}

}  // namespace glissade::devices

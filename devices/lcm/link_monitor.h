#pragma once

/// The filter behind the decoder: admits the messages of one sender, in rising sequence, and counts what it admits and
/// rejects.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include <glissade/devices/lcm_bus.h>

namespace glissade::devices {

enum class MessageError {
  kNone,
  kWrongSize,
  kUndecodable,
  kWrongVersion,
  kNotFinite,
  kOutOfRange,
  kOtherReceiver,
  kOtherSender,
  kOutOfSequence
};

/// The outcome of decoding a message.
struct DecodeResult {
  MessageError error = MessageError::kNone;
  RefusedField field{};  ///< with an error, the first field that is wrong; no name if none is known

  DecodeResult() = default;
  DecodeResult(MessageError kind) : error(kind) {}  // NOLINT(google-explicit-constructor): most errors have no field
  DecodeResult(MessageError kind, const RefusedField& wrong) : error(kind), field(wrong) {}
  operator MessageError() const noexcept { return error; }  // NOLINT(google-explicit-constructor)
};

/// The reason for refusing a message for its contents, such as "a number is not finite".
std::string_view words_of(MessageError error) noexcept;
/// The same with the field, such as "a number is not finite: position_WH_m[1] is nan".
std::string text_of(const DecodeResult& result);

/// Who sent a message, and its place among the messages of this sender.
struct MessageOrigin {
  std::int64_t device = 0;
  std::int64_t session = 0;
  std::int64_t sequence = 0;
};

/// The sender whose messages are admitted holds a lease. Another device or session gets it only after `lease` without
/// an admitted message. Sequence numbers of the holder rise, no faster than `kGreatestRate` in the mean. They may
/// rise by `kBurst` at once, and after a silence by what the rate allows, at most `kGreatestAdvance`. After `lease`
/// without an admitted message, two messages of the holder in rising sequence are a new start. So a forged message with
/// a great number locks its sender out for little more than one lease. Thread-safety: `admit` in the receive thread,
/// `grant` before the first `admit`, the rest in any.
class LinkMonitor {
 public:
  /// Messages a second that nobody exceeds.
  static constexpr double kGreatestRate = 20e3;

  /// Messages that may be missing after any silence.
  static constexpr double kGreatestAdvance = 2000.0;
  /// Messages that may be missing at the start, or between two refused messages.
  static constexpr double kBurst = 50.0;

  explicit LinkMonitor(std::chrono::nanoseconds lease) : lease_(lease) {}

  /// Before the first message: grants the lease to this sender at `now`.
  void grant(std::int64_t device, std::int64_t session, std::chrono::nanoseconds now) noexcept;

  /// Counts a message that was decoded with `result` at `now`; returns whether it may be used.
  bool admit(const DecodeResult& result, const MessageOrigin& origin, std::chrono::nanoseconds now) noexcept;

  /// Session of the sender that held the lease last; 0 before the first admitted message.
  std::int64_t session() const noexcept { return session_.load(std::memory_order_relaxed); }
  /// Session of the sender that holds the lease at `now`; 0 if nobody does.
  std::int64_t leaseholder(std::chrono::nanoseconds now) const noexcept {
    return now - last_time_.load(std::memory_order_relaxed) < lease_ ? session() : 0;
  }

  LinkStatistics statistics() const noexcept;

 private:
  static constexpr std::size_t kErrors = 9;

  /// Written once.
  struct First {
    RefusedField field;
    std::atomic<bool> is_known{false};
  };

  bool follows(std::int64_t sequence, std::chrono::nanoseconds silence) noexcept;
  MessageError check(const MessageOrigin& origin, std::chrono::nanoseconds now) noexcept;

  std::chrono::nanoseconds lease_;
  std::atomic<std::chrono::nanoseconds> last_time_{std::chrono::nanoseconds(0)};
  std::int64_t last_sequence_ = -1;     ///< −1 before the first message of a lease
  double budget_ = 0.0;                 ///< by which the next sequence may rise at `last_time_`
  std::int64_t refused_sequence_ = -1;  ///< of the holder's message refused last; −1 if the last one was admitted
  std::int64_t device_ = 0;
  std::atomic<std::int64_t> session_{0};
  std::array<std::atomic<std::uint64_t>, kErrors> counts_{};  ///< by MessageError
  std::array<First, kErrors> firsts_{};                       ///< by MessageError
  std::atomic<std::uint64_t> lost_{0};
};

/// A random number from 1 to 2⁶² for a session. May block.
std::int64_t random_session();

}  // namespace glissade::devices

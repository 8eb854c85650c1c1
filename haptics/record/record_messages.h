#pragma once

/// Conversion between the records of a loop and bytes in a log, with all bits of every number.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glissade/haptics/recording.h>

namespace glissade::haptics {

inline constexpr const char* kHapticTickChannel = "HAPTIC_TICK";
inline constexpr const char* kContactSetChannel = "CONTACT_SET";

std::vector<std::uint8_t> encode(const TickRecord& record);
std::vector<std::uint8_t> encode(const AnswerRecord& record);

/// Whether `bytes`, whose checksum is right, are those of the record.
bool is_message_of(const TickRecord& record, std::span<const std::uint8_t> bytes);
bool is_message_of(const AnswerRecord& record, std::span<const std::uint8_t> bytes);

inline constexpr std::size_t kMessagesAtOnce = 4;
/// Whether the checksums at the ends of several messages are right. Takes little longer than for one. A message without
/// a checksum, such as an empty one, has none that is right.
std::array<bool, kMessagesAtOnce> have_right_checksums(
    const std::array<std::span<const std::uint8_t>, kMessagesAtOnce>& messages);

/// What a tick consumed, and its duration. What it produced is not read: only `devices::SafetyEnvelope` makes commands.
/// No value for bytes that are no such message, or whose checksum is wrong.
std::optional<TickRecord> decode_tick(std::span<const std::uint8_t> bytes);
/// What an answer consumed, and the number and the parts of its set. The parts that hands hold are among them.
struct ConsumedByAnswer {
  Ghosts ghosts;
  std::int64_t sequence = 0;
  std::int32_t part_count = 0;
};
/// The checksum is not looked at: see `have_right_checksums`.
std::optional<ConsumedByAnswer> decode_answer(std::span<const std::uint8_t> bytes);

}  // namespace glissade::haptics

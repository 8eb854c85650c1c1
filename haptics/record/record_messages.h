#pragma once

/// Conversion between the records of a loop and bytes in a log, with all bits of every number.

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

/// Whether `bytes`, which `decode_tick` or `decode_answer` could read, are those of the record.
bool is_message_of(const TickRecord& record, std::span<const std::uint8_t> bytes);
bool is_message_of(const AnswerRecord& record, std::span<const std::uint8_t> bytes);

/// What a tick consumed, and its duration. What it produced is not read: only `devices::SafetyEnvelope` makes commands.
/// No value for bytes that are no such message, or whose checksum is wrong.
std::optional<TickRecord> decode_tick(std::span<const std::uint8_t> bytes);
/// What an answer consumed, and the number and the parts of its set. The parts that hands hold are among them.
struct ConsumedByAnswer {
  Ghosts ghosts;
  std::int64_t sequence = 0;
  std::int32_t part_count = 0;
};
std::optional<ConsumedByAnswer> decode_answer(std::span<const std::uint8_t> bytes);

}  // namespace glissade::haptics

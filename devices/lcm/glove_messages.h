#pragma once

/// Conversion between what gloves send and get, and bytes on the wire. Every received message is checked here before it
/// is used.

#include <cstdint>
#include <span>
#include <vector>

#include <glissade/devices/glove_device.h>

#include "lcm/link_monitor.h"

namespace glissade::devices {

inline constexpr const char* kGloveInfoChannel = "GLOVE_INFO";
inline constexpr const char* kGloveStateChannel = "GLOVE_STATE";
inline constexpr const char* kGloveCommandChannel = "GLOVE_COMMAND";

/// What the message of a state says of the link.
struct StateHeader {
  std::int64_t device = 0;
  std::int64_t session = 0;      ///< of the glove
  std::int64_t leaseholder = 0;  ///< session of the server whose commands the glove obeys; 0: of none
  hands::HandSide side = hands::HandSide::kUnknown;
};

/// What the message of a command says of the link.
struct CommandHeader {
  std::int64_t device = 0;
  std::int64_t glove_session = 0;
  std::int64_t session = 0;  ///< of the server
};

/// A name of more than 31 bytes is cut.
std::vector<std::uint8_t> encode(const GloveInfo& info);
std::vector<std::uint8_t> encode(const StateHeader& header, const GloveState& state);
std::vector<std::uint8_t> encode(const CommandHeader& header, const GloveCommand& command);

/// Decodes and checks a message. With any result other than kNone, the output is unchanged. Never throws, for any
/// bytes. kOutOfRange: also for a descriptor that `validate` refuses.
DecodeResult decode(std::span<const std::uint8_t> bytes, GloveInfo& info) noexcept;
DecodeResult decode(std::span<const std::uint8_t> bytes, StateHeader& header, GloveState& state) noexcept;
DecodeResult decode(std::span<const std::uint8_t> bytes, CommandHeader& header, GloveCommand& command) noexcept;

}  // namespace glissade::devices

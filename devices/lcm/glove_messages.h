#pragma once

/// Conversion between our types and bytes on the wire. Every received message is checked here before it is used.

#include <cstdint>
#include <span>
#include <vector>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>

#include "lcm/link_monitor.h"

namespace glissade::devices {

inline constexpr const char* kGloveStateChannel = "GLOVE_STATE";
inline constexpr const char* kGloveCommandChannel = "GLOVE_COMMAND";
inline constexpr const char* kHapticStateChannel = "HAPTIC_STATE";

std::vector<std::uint8_t> encode(const GloveState& state);
std::vector<std::uint8_t> encode(const GloveCommand& command);
std::vector<std::uint8_t> encode(const HapticState& state);

/// Decodes and checks a message. With any result other than kNone, the output is unchanged. Never throws, for any
/// bytes.
MessageError decode(std::span<const std::uint8_t> bytes, GloveState& state) noexcept;
MessageError decode(std::span<const std::uint8_t> bytes, GloveCommand& command) noexcept;
/// A part state that this program does not know becomes `PartState::kUnknown`. This is no error: a viewer may be older
/// than the simulation.
MessageError decode(std::span<const std::uint8_t> bytes, HapticState& state) noexcept;

}  // namespace glissade::devices

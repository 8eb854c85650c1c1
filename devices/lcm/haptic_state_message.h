#pragma once

/// Conversion between the state of a tick for viewers and bytes on the wire.

#include <cstdint>
#include <span>
#include <vector>

#include <glissade/devices/haptic_state.h>

#include "lcm/link_monitor.h"

namespace glissade::devices {

inline constexpr const char* kHapticStateChannel = "HAPTIC_STATE";

std::vector<std::uint8_t> encode(const HapticState& state);

/// Decodes and checks a message. With any result other than kNone, the output is unchanged. Never throws, for any
/// bytes. A part state that this program does not know becomes `PartState::kUnknown`. This is no error: a viewer may be
/// older than the simulation.
DecodeResult decode(std::span<const std::uint8_t> bytes, HapticState& state) noexcept;

}  // namespace glissade::devices

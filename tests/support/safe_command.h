#pragma once

/// Safe commands for tests: the only way to them is through an envelope.

#include <chrono>

#include <glissade/devices/safety_envelope.h>

namespace glissade::test_support {

/// One period: `wanted` answers `state`, which has just been measured.
inline devices::SafeCommand limited(devices::SafetyEnvelope& envelope, devices::GloveCommand wanted,
                                    const devices::GloveState& state) {
  wanted.state_time = state.time;
  return envelope.limit(wanted, state, state.time);
}

/// `wanted` for a hand at rest, once its force has come up softly.
inline devices::SafeCommand safe_command(const devices::GloveCommand& wanted,
                                         const devices::DeviceDescriptor& descriptor) {
  devices::SafetyEnvelope envelope(descriptor);
  devices::GloveState state;
  devices::SafeCommand safe;
  for (int i = 0; i < 500; ++i) {
    state.time += std::chrono::milliseconds(1);
    ++state.sequence;
    safe = limited(envelope, wanted, state);
  }
  return safe;
}

}  // namespace glissade::test_support

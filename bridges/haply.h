#pragma once

/// Constants and types for Haply's devices, for the bridge and for the emulator. A program, Haply's Inverse Service,
/// drives the devices. Other programs talk to it over a WebSocket.

namespace glissade::bridges {

/// TCP port of the service.
inline constexpr unsigned short kHaplyPort = 10001;

/// The preset of `devices::read_glove_model` with the numbers of an Inverse3.
inline constexpr const char* kInverse3Preset = "inverse3";

/// The changes that the service makes to a force before the device exerts it.
struct HaplyFilters {
  /// While the force oscillates, the gate takes this share of it away. The meaning of the real gate's gain is not
  /// documented.
  double force_gate = 0.3;
  double damping_N_s_per_m = 0.0;  ///< at the start of a session, which may set its own
  double force_scale = 1.0;
};

}  // namespace glissade::bridges

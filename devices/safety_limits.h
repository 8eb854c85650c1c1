#pragma once

/// The last gate before a device: whatever was computed, this is what it may be sent.

#include <glissade/devices/glove_device.h>

namespace glissade::devices {

/// What had to be changed, and why.
struct LimitReasons {
  bool not_finite = false;      ///< a number was NaN or infinite, so everything was set to zero
  bool force_limited = false;   ///< the force was scaled down to the device's greatest
  bool torque_limited = false;  ///< likewise the torque
  bool joints_limited = false;  ///< at least one joint torque was cut off

  bool any() const noexcept { return not_finite || force_limited || torque_limited || joints_limited; }
};

/// A command within the limits.
struct LimitedCommand {
  GloveCommand command;
  LimitReasons reasons;
};

/// Scales force and torque down to the norms the device allows, keeping their directions, and clamps each joint torque.
/// A command with any number that is not finite becomes no force at all. Sequences and time pass through. The result
/// never exceeds a limit, not even by rounding; a limit that is NaN or negative allows nothing. Real-time safe.
LimitedCommand limit_command(const GloveCommand& command, const DeviceDescriptor& descriptor) noexcept;

}  // namespace glissade::devices

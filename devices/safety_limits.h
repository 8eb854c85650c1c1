#pragma once

/// The last check of a command before it goes to a device: reduces the command to the limits of the device.

#include <glissade/devices/glove_device.h>

namespace glissade::devices {

/// Reasons for changes to a command.
struct LimitReasons {
  bool not_finite = false;      ///< a number was NaN or infinite, so all forces and torques were set to zero
  bool force_limited = false;   ///< the force was scaled down to the device's maximum
  bool torque_limited = false;  ///< the torque was scaled down to the device's maximum
  bool joints_limited = false;  ///< at least one joint torque was clamped

  bool any() const noexcept { return not_finite || force_limited || torque_limited || joints_limited; }
};

/// A command within the limits, and the reasons for its changes.
struct LimitedCommand {
  GloveCommand command;
  LimitReasons reasons;
};

/// Scales force and torque down to the norms that the device allows, without changing their directions, and clamps each
/// joint torque. If any component of force, torque or joint torques is not finite, all components become zero.
/// The sequence numbers and the time do not change. The result never exceeds a limit, not even by rounding. A limit
/// that is NaN or negative counts as 0. Real-time safe.
LimitedCommand limit_command(const GloveCommand& command, const DeviceDescriptor& descriptor) noexcept;

}  // namespace glissade::devices

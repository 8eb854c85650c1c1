#pragma once

/// The stiffness that a device can render passively.

#include <algorithm>
#include <chrono>

#include <glissade/devices/glove_device.h>

namespace glissade::haptics {

/// Seconds by which the force lags behind the motion: half a period, because it is held that long, and all delays.
inline double lag_of(const devices::DeviceDescriptor& device, std::chrono::nanoseconds period,
                     std::chrono::nanoseconds delay) noexcept {
  const double seconds = std::max(std::chrono::duration<double>(period).count(), 1.0 / device.update_rate);
  return 0.5 * seconds + std::chrono::duration<double>(device.delay + delay).count();
}

/// The largest stiffness that is passive with the damping `told` at this lag (seconds), in units that fit each other.
/// If the descriptor does not tell the damping (0), the device is taken to have just as much as `greatest`, its largest
/// stiffness, needs to be passive without a link.
inline double passive_limit(const devices::DeviceDescriptor& device, double told, double greatest,
                            double lag) noexcept {
  if (told > 0.0) return told / lag;
  return greatest * (lag_of(device, std::chrono::nanoseconds(0), std::chrono::nanoseconds(0)) / lag);
}

}  // namespace glissade::haptics

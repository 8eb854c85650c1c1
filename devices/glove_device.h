#pragma once

/// A glove as the haptic loop sees it: the newest state in, the newest command out, and never a wait.

#include <glissade/devices/glove_types.h>

namespace glissade::devices {

/// Thread-safety: one thread, the haptic one, calls `read` and `command`. Both are wait-free, allocate nothing and make
/// no system call; whatever has to wait for a device does so in a thread of the implementation.
class GloveDevice {
 public:
  virtual ~GloveDevice() = default;

  /// Fixed for the life of the device.
  virtual const DeviceDescriptor& descriptor() const noexcept = 0;

  /// Puts the newest state into `newest`; returns false, and leaves it alone, until the first one has come. The state's
  /// sequence tells whether it is a new one.
  virtual bool read(GloveState& newest) noexcept = 0;

  /// Sends `command`; one that was not sent yet is overtaken.
  virtual void command(const GloveCommand& command) noexcept = 0;
};

}  // namespace glissade::devices

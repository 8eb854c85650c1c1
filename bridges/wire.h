#pragma once

/// The wire of a device: its own protocol over a line such as a serial port. A bridge connects it to the link of
/// gloves.

#include <chrono>
#include <stdexcept>
#include <string>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/safety_envelope.h>

namespace glissade::bridges {

/// The wire cannot be opened, or has failed. `what` says what is wrong, where, and what helps: a port that is not
/// there, missing rights, another baud rate, no answer, other firmware.
class WireError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A device behind its own wire. One thread calls all functions. They may block for about a period.
class Wire {
 public:
  virtual ~Wire() = default;

  /// What the device announces. It never changes.
  virtual const devices::DeviceDescriptor& descriptor() const noexcept = 0;

  /// Opens the wire, or opens it anew after an error. Throws WireError.
  virtual void open() = 0;

  /// Waits for at most a period for the next measurement and writes its numbers into `state`: the time (monotonic
  /// clock), and those of angles, pose and velocities that the device measures. Returns whether a measurement came.
  /// Throws WireError.
  virtual bool read(devices::GloveState& state) = 0;

  /// Sends the command of this period. Throws WireError.
  virtual void write(const devices::SafeCommand& command) = 0;

  /// Lets go of the hand, as far as the wire still permits. Called at the end and after each error.
  virtual void release() noexcept = 0;
};

}  // namespace glissade::bridges

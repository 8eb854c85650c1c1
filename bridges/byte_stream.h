#pragma once

/// A line that carries bytes both ways, such as a serial port. The wires of devices use this interface, so they work
/// with real ports and with emulated devices.

#include <chrono>
#include <string>
#include <string_view>

namespace glissade::bridges {

/// One connection at a time. One thread calls all functions.
class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// Names the line in messages, such as "/dev/ttyUSB0".
  virtual std::string name() const = 0;

  /// Opens the line, or opens it anew. Bytes that arrived earlier are dropped. Throws WireError, which says what is
  /// wrong and what helps.
  virtual void open() = 0;

  /// Closes the line. A closed line may be opened again.
  virtual void close() noexcept = 0;

  virtual bool is_open() const noexcept = 0;

  /// Sends all bytes. Throws WireError if the line is closed or gone, or does not take the bytes.
  virtual void write(std::string_view bytes) = 0;

  /// Returns the bytes that have arrived. If there are none, waits up to `patience` for the first bytes. The result is
  /// empty if none come. Throws WireError if the line is closed or gone.
  virtual std::string read(std::chrono::nanoseconds patience) = 0;

  /// The file descriptor of the open line, for use by another process; −1 if there is none.
  virtual int descriptor() const noexcept = 0;
};

}  // namespace glissade::bridges

#pragma once

/// A stream of bytes to a device: a serial port (USB or Bluetooth), or a TCP connection.

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace glissade::bridges {

/// One connection at a time. `open` makes a new one after an error. Not thread-safe.
class SerialStream {
 public:
  /// `port` is the path of a serial port, such as "/dev/ttyUSB0", or "tcp:HOST" or "tcp:HOST:PORT". Nothing is opened
  /// yet. Throws std::invalid_argument if the port of a TCP address is no number from 1 to 65535.
  SerialStream(std::string port, unsigned baud_rate, unsigned short default_tcp_port);
  ~SerialStream();

  /// Connects: a serial port with 8 data bits, no parity, 1 stop bit and no flow control, for this program alone. Bytes
  /// that the port has received before are dropped. Throws WireError, which says what is wrong and what helps. A TCP
  /// connection takes at most 0.8 s.
  void open();
  void close() noexcept;
  bool is_open() const noexcept;

  /// Waits until bytes arrive, for at most `patience`. Returns their number, 0 if none came. Throws WireError if the
  /// connection is lost.
  std::size_t read(std::span<char> bytes, std::chrono::nanoseconds patience);

  /// Sends all bytes, or throws WireError: if the connection is lost, or the device does not take the bytes within
  /// 0.1 s.
  void write(std::string_view bytes);

  /// The descriptor of the system for the connection; −1 if there is none.
  int descriptor() const noexcept;
  const std::string& port() const noexcept;

 private:
  struct Connection;

  std::unique_ptr<Connection> connection_;
};

}  // namespace glissade::bridges

#pragma once

/// A stream of bytes to a device: a serial port (USB or Bluetooth), or a TCP connection.

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include <glissade/bridges/byte_stream.h>

namespace glissade::bridges {

/// `open` connects to a serial port for this program alone, with 8 data bits, no parity, 1 stop bit, no flow control,
/// and any baud rate that the port takes. By TCP, `open` connects within 0.8 s. Looking up the name of a host takes
/// another 0.8 s at most. `write` throws if the device does not take the bytes within 0.1 s.
class SerialStream final : public ByteStream {
 public:
  /// `port` is the path of a serial port, such as "/dev/ttyUSB0", or "tcp:HOST:PORT". With a default TCP port,
  /// "tcp:HOST" will do. Nothing is opened yet. Throws std::invalid_argument if the port of a TCP address is missing or
  /// no number from 1 to 65535.
  SerialStream(std::string port, unsigned baud_rate, unsigned short default_tcp_port = 0);
  ~SerialStream() override;

  std::string name() const override;
  void open() override;
  void close() noexcept override;
  bool is_open() const noexcept override;
  void write(std::string_view bytes) override;
  std::string read(std::chrono::nanoseconds patience) override;
  int descriptor() const noexcept override;

 private:
  struct Connection;

  std::unique_ptr<Connection> connection_;
};

}  // namespace glissade::bridges

#pragma once

/// The connection to Haply's Inverse Service: text messages over a WebSocket, and nothing that can wait for ever.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::bridges {

/// Where the service listens: the address of a machine, which needs no look-up, and a TCP port.
struct ServiceAddress {
  std::string host;
  unsigned short port = 0;

  std::string text() const { return host + ":" + std::to_string(port); }
};

/// "HOST" or "HOST:PORT", where HOST is "localhost" or an address such as 192.168.1.5. Throws std::invalid_argument:
/// the look-up of a name has no limit of time.
ServiceAddress parse_service_address(std::string_view text);

/// A client. One thread calls all functions.
class WebSocket {
 public:
  explicit WebSocket(ServiceAddress address);
  /// Closes.
  ~WebSocket();

  const std::string& name() const noexcept;
  bool is_open() const noexcept;

  /// Connects within two seconds. Throws WireError, which says what is wrong.
  void open();
  /// Tells the service the end, within 0.1 s.
  void close() noexcept;

  /// The next message, if it comes within `patience`. Throws WireError if the connection is lost.
  std::optional<std::string> receive(std::chrono::nanoseconds patience);
  /// Throws WireError if the connection is lost, or the service takes nothing for 0.1 s.
  void send(const std::string& message);

  /// What an HTTP GET of `target` at the same address gives; no value if there is no such page within a second.
  static std::optional<std::string> get(const ServiceAddress& address, const std::string& target);

 private:
  struct Connection;

  std::unique_ptr<Connection> connection_;
};

}  // namespace glissade::bridges

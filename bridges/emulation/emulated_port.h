#pragma once

/// The device's end of a serial port or of a TCP connection, for emulators.

#include <string>
#include <string_view>
#include <vector>

#include <poll.h>

namespace glissade::bridges {

/// A pseudo-terminal, or a TCP port of this machine with one host at a time. Not thread-safe.
class EmulatedPort {
 public:
  /// Not plugged yet. `link` is the path of a link to the pseudo-terminal; empty: none.
  static EmulatedPort terminal(std::string link);
  /// `number` 0 takes any port that is free, and keeps it.
  static EmulatedPort tcp(unsigned short number);

  ~EmulatedPort();
  EmulatedPort(EmulatedPort&& other) noexcept;
  EmulatedPort& operator=(EmulatedPort&&) = delete;

  /// Throws std::system_error if the system refuses.
  void plug();
  void unplug() noexcept;

  /// What a host opens; empty if there is no plug in and no link.
  const std::string& name() const noexcept { return name_; }

  /// The rate that the host has set; 0 if it has set none, and by TCP.
  unsigned baud_rate() const noexcept;
  /// Adds what to wait for until the host sends bytes or connects.
  void add_to(std::vector<pollfd>& waiting) const;

  /// The bytes that have come from the host. Does not wait.
  std::string read();
  /// Bytes that find no room are lost.
  void write(std::string_view bytes) noexcept;

 private:
  EmulatedPort() = default;
  void plug_terminal();
  void plug_tcp();
  void accept_host() noexcept;

  bool is_tcp_ = false;
  std::string link_;
  unsigned short tcp_port_ = 0;
  std::string name_;
  int device_ = -1;    ///< the device's side of the pseudo-terminal, or the connection
  int host_ = -1;      ///< the other side, so that the device sees no end between two hosts
  int listener_ = -1;  ///< of TCP
};

}  // namespace glissade::bridges

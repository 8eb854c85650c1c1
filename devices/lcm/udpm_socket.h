#pragma once

/// The receiving socket of an address of the provider udpm. liblcm's own socket takes datagrams to any address of this
/// machine, from any interface, and its assembly of fragments can be overrun.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <netinet/in.h>

#include "lcm/lcm_packet.h"
#include "lcm/lcm_url.h"

namespace glissade::devices {

/// Takes datagrams to the multicast group only, and only from the interface to which this machine routes the group.
/// With a ttl of 0 it takes only those of this machine. Not thread-safe.
class UdpmSocket {
 public:
  /// Joins the group. Throws std::system_error if the system refuses.
  explicit UdpmSocket(const UdpmAddress& address);
  ~UdpmSocket();
  UdpmSocket(const UdpmSocket&) = delete;
  UdpmSocket& operator=(const UdpmSocket&) = delete;

  /// Readable while a datagram waits.
  int fd() const noexcept { return fd_; }

  enum class Outcome { kMessage, kRefused, kNothing, kError };

  /// Takes one datagram, without waiting. With kMessage, `packet` refers to bytes that are valid until the next call.
  /// kRefused: it was none of a small message, or came from elsewhere.
  Outcome receive(LcmPacket& packet) noexcept;

 private:
  int fd_;
  std::optional<in_addr> only_source_;
  std::array<std::uint8_t, 65536> buffer_{};
};

}  // namespace glissade::devices

#pragma once

/// Checks LCM addresses before liblcm gets them: liblcm silently replaces errors by defaults, and writes reports of its
/// own to stderr.

#include <optional>
#include <string>

#include <netinet/in.h>

namespace glissade::devices {

/// Where an address of the provider udpm sends to and receives from.
struct UdpmAddress {
  sockaddr_in group{};  ///< multicast address and port
  int ttl = 0;          ///< 0: messages stay on this machine
  /// Bytes of the receive buffer, of which the system grants at most `net.core.rmem_max`. The default holds a fifth of
  /// a second of the messages of four gloves and their server.
  int buffer_size = 4 << 20;
};

/// The address that `url` names; none for `memq://`. Allowed are `memq://` and `udpm://ADDRESS:PORT`, the latter with
/// or without the options `ttl` and `recv_buf_size`. ADDRESS is an IPv4 multicast address to which this machine has a
/// route. Throws std::invalid_argument, naming the URL and its error, for any other. Sends nothing.
std::optional<UdpmAddress> check_lcm_url(const std::string& url);

}  // namespace glissade::devices

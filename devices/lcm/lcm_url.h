#pragma once

/// Checks LCM addresses before liblcm gets them: liblcm silently replaces errors by defaults, and writes reports of its
/// own to stderr.

#include <string>

namespace glissade::devices {

enum class LcmProvider { kMemq, kUdpm };

/// The provider that `url` names. Allowed are `memq://` and `udpm://ADDRESS:PORT`, the latter with or without the
/// options `ttl` and `recv_buf_size`. ADDRESS is an IPv4 multicast address to which this machine has a route. Throws
/// std::invalid_argument, naming the URL and its error, for any other. Sends nothing.
LcmProvider check_lcm_url(const std::string& url);

}  // namespace glissade::devices

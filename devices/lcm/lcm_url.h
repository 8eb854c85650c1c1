#pragma once

/// Checks LCM addresses before liblcm sees them: it takes silent defaults, and reports on stderr in lines of its own.

#include <string>

namespace glissade::devices {

enum class LcmProvider { kMemq, kUdpm };

/// Which provider `url` names. Throws std::invalid_argument, naming the URL and what is wrong with it, unless it is
/// `memq://` or `udpm://ADDRESS:PORT`, with the options `ttl` and `recv_buf_size` or none, where ADDRESS is an IPv4
/// multicast address to which this machine has a route. Sends nothing.
LcmProvider check_lcm_url(const std::string& url);

}  // namespace glissade::devices

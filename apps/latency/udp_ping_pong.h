#pragma once

/// A bare round trip of a glove's two messages over UDP multicast, as a measure of what the system costs: blocking
/// sockets, no LCM, no checks.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include <glissade/realtime/latency_histogram.h>

namespace glissade::apps {

/// Each way has a port of its own, because a socket that has joined a group also receives what it sends there.
struct PingPongAddress {
  std::uint16_t ping_port = 0;
  std::uint16_t pong_port = 0;
};

/// The group of `address`, which does not leave this machine.
inline constexpr const char* kPingPongGroup = "239.255.76.68";

/// Sends a pong for each ping, until `should_end` is true. Both functions ask for SCHED_FIFO at the haptic loop's
/// priority, and throw std::system_error when the system refuses a socket.
void send_pongs(const PingPongAddress& address, const std::atomic<bool>& should_end);

/// Sends pings, one a millisecond, as long as `go_on` returns true; the time until the pong is back goes into
/// `round_trip`.
void send_pings(const PingPongAddress& address, const std::function<bool()>& go_on,
                realtime::LatencyHistogram& round_trip);

}  // namespace glissade::apps

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <glissade/apps/latency/latency_rules.h>
#include <glissade/apps/latency/udp_ping_pong.h>
#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/glove_state_t.hpp>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

constexpr std::size_t kLargestDatagram = 2048;
constexpr timeval kDatagramPatience{.tv_sec = 0, .tv_usec = 100'000};  // a datagram that has not come by then is lost

/// The size of a message in a packet of LCM: 8 bytes, and the channel's name with a zero.
template <typename Message>
std::vector<std::uint8_t> datagram_like(const char* channel) {
  return std::vector<std::uint8_t>(8 + std::strlen(channel) + 1 + static_cast<std::size_t>(Message().getEncodedSize()));
}

/// Receives what is sent to one port of the group, and sends to another.
class GroupSocket {
 public:
  GroupSocket(std::uint16_t from_port, std::uint16_t to_port)
      : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)), to_(address_of(to_port)) {
    if (fd_ < 0) fail();
    const sockaddr from = address_of(from_port);
    ip_mreq membership{};
    membership.imr_multiaddr.s_addr = inet_addr(kPingPongGroup);
    set(SOL_SOCKET, SO_RCVTIMEO, kDatagramPatience);
    set(IPPROTO_IP, IP_MULTICAST_TTL, 0);
    if (bind(fd_, &from, sizeof(from)) != 0) fail();
    set(IPPROTO_IP, IP_ADD_MEMBERSHIP, membership);
  }
  ~GroupSocket() { close(fd_); }
  GroupSocket(const GroupSocket&) = delete;
  GroupSocket& operator=(const GroupSocket&) = delete;

  bool send(const std::vector<std::uint8_t>& datagram) const {
    return sendto(fd_, datagram.data(), datagram.size(), 0, &to_, sizeof(to_)) >= 0;
  }
  /// Waits for a datagram, not for ever.
  bool receive() const {
    std::array<std::uint8_t, kLargestDatagram> datagram;
    return recv(fd_, datagram.data(), datagram.size(), 0) >= 0;
  }

 private:
  [[noreturn]] void fail() const {
    const int error = errno;
    if (fd_ >= 0) close(fd_);
    throw std::system_error(error, std::generic_category(), "The UDP ping-pong gets no socket");
  }

  template <typename Value>
  void set(int level, int option, const Value& value) const {
    if (setsockopt(fd_, level, option, &value, sizeof(value)) != 0) fail();
  }

  static sockaddr address_of(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = inet_addr(kPingPongGroup);
    sockaddr result{};
    std::memcpy(&result, &address, sizeof(result));
    return result;
  }

  int fd_;
  sockaddr to_;
};

}  // namespace

void send_pongs(const PingPongAddress& address, const std::atomic<bool>& should_end) {
  const GroupSocket socket(address.ping_port, address.pong_port);
  const std::vector<std::uint8_t> pong = datagram_like<glissade::glove_command_t>("GLOVE_COMMAND");
  realtime::SteadyClock clock;
  realtime::PeriodicThread thread(clock, {.fifo_priority = realtime::kHapticPriority, .name = "pong"},
                                  [&](const realtime::PeriodicTick&) {
                                    while (!should_end.load()) {
                                      if (socket.receive()) socket.send(pong);
                                    }
                                    return false;
                                  });
  thread.join();
}

void send_pings(const PingPongAddress& address, const std::function<bool()>& go_on,
                realtime::LatencyHistogram& round_trip) {
  const GroupSocket socket(address.pong_port, address.ping_port);
  const std::vector<std::uint8_t> ping = datagram_like<glissade::glove_state_t>("GLOVE_STATE");
  realtime::SteadyClock clock;
  realtime::PeriodicThread thread(clock, {.fifo_priority = realtime::kHapticPriority, .name = "ping"},
                                  [&](const realtime::PeriodicTick&) {
                                    const std::chrono::nanoseconds sent = clock.now();
                                    if (socket.send(ping) && socket.receive()) round_trip.record(clock.now() - sent);
                                    return go_on();
                                  });
  thread.join();
}

}  // namespace glissade::apps

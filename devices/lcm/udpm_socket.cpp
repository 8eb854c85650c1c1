#include "lcm/udpm_socket.h"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

namespace glissade::devices {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// Closes a socket unless it is released.
class Socket {
 public:
  explicit Socket(int flags) : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | flags, 0)) {
    if (fd_ < 0) fail("No socket for LCM");
  }
  ~Socket() {
    if (fd_ >= 0) close(fd_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  int fd() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

  template <typename Value>
  void set(int level, int option, const Value& value) const {
    if (setsockopt(fd_, level, option, &value, sizeof(value)) != 0) fail("An option of the socket for LCM is refused");
  }

 private:
  int fd_;
};

sockaddr generic(const sockaddr_in& address) {
  sockaddr result{};
  std::memcpy(&result, &address, sizeof(result));
  return result;
}

sockaddr_in internet(const sockaddr& address) {
  sockaddr_in result{};
  std::memcpy(&result, &address, sizeof(result));
  return result;
}

/// The address from which this machine sends to the group; 0.0.0.0 where the group is routed to the loopback interface.
/// Connecting a UDP socket sends nothing.
in_addr own_address(const sockaddr_in& group) {
  const Socket probe(0);
  const sockaddr to = generic(group);
  if (connect(probe.fd(), &to, sizeof(to)) != 0) fail("No route to the multicast group of LCM");
  sockaddr own{};
  socklen_t size = sizeof(own);
  if (getsockname(probe.fd(), &own, &size) != 0) fail("No address of this machine for LCM");
  return internet(own).sin_addr;
}

}  // namespace

UdpmSocket::UdpmSocket(const UdpmAddress& address) : fd_(-1) {
  if (address.ttl == 0) only_source_ = own_address(address.group);

  Socket result(SOCK_NONBLOCK);
  result.set(SOL_SOCKET, SO_REUSEADDR, 1);  // other programs on this machine listen to the same group
  result.set(SOL_SOCKET, SO_RCVBUF, address.buffer_size);
  // Bound to the group, the socket takes no datagram to another address. Without IP_MULTICAST_ALL, it takes none that
  // arrives by another interface than the one by which it has joined; the system chooses this one by its routes.
  result.set(IPPROTO_IP, IP_MULTICAST_ALL, 0);
  const sockaddr group = generic(address.group);
  if (bind(result.fd(), &group, sizeof(group)) != 0) fail("The port of LCM cannot be bound");
  ip_mreq membership{};
  membership.imr_multiaddr = address.group.sin_addr;
  result.set(IPPROTO_IP, IP_ADD_MEMBERSHIP, membership);
  fd_ = result.release();
}

UdpmSocket::~UdpmSocket() {
  close(fd_);
}

UdpmSocket::Outcome UdpmSocket::receive(LcmPacket& packet) noexcept {
  sockaddr from{};
  socklen_t size = sizeof(from);
  const ssize_t received = recvfrom(fd_, buffer_.data(), buffer_.size(), 0, &from, &size);
  if (received < 0) return errno == EAGAIN || errno == EINTR ? Outcome::kNothing : Outcome::kError;
  if (only_source_ && internet(from).sin_addr.s_addr != only_source_->s_addr) return Outcome::kRefused;
  const auto parsed = parse_packet({buffer_.data(), static_cast<std::size_t>(received)});
  if (!parsed) return Outcome::kRefused;
  packet = *parsed;
  return Outcome::kMessage;
}

}  // namespace glissade::devices

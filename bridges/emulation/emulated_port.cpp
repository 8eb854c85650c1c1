#include "emulation/emulated_port.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "stream/baud_rate.h"

namespace glissade::bridges {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void close_if_open(int& descriptor) noexcept {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

/// Bytes pass as they are, and none come back.
void make_raw(int descriptor) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) refuse("pseudo-terminal");
  cfmakeraw(&settings);
  tcsetattr(descriptor, TCSANOW, &settings);
}

}  // namespace

EmulatedPort EmulatedPort::terminal(std::string link) {
  EmulatedPort port;
  port.name_ = link;
  port.link_ = std::move(link);
  return port;
}

EmulatedPort EmulatedPort::tcp(unsigned short number) {
  EmulatedPort port;
  port.is_tcp_ = true;
  port.tcp_port_ = number;
  return port;
}

EmulatedPort::EmulatedPort(EmulatedPort&& other) noexcept
    : is_tcp_(other.is_tcp_),
      link_(std::exchange(other.link_, {})),
      tcp_port_(other.tcp_port_),
      name_(std::move(other.name_)),
      device_(std::exchange(other.device_, -1)),
      host_(std::exchange(other.host_, -1)),
      listener_(std::exchange(other.listener_, -1)) {}

EmulatedPort::~EmulatedPort() {
  unplug();
}

void EmulatedPort::plug() {
  unplug();
  is_tcp_ ? plug_tcp() : plug_terminal();
}

void EmulatedPort::plug_terminal() {
  device_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (device_ < 0 || grantpt(device_) != 0 || unlockpt(device_) != 0) refuse("pseudo-terminal");
  std::array<char, 64> path{};
  if (ptsname_r(device_, path.data(), path.size()) != 0) refuse("pseudo-terminal");
  host_ = ::open(path.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (host_ < 0) refuse(path.data());
  make_raw(host_);
  name_ = path.data();
  if (link_.empty()) return;
  // In place of a link that a killed emulator has left, but never of another file.
  std::error_code none;
  if (std::filesystem::read_symlink(link_, none).string().starts_with("/dev/pts/")) std::filesystem::remove(link_);
  std::filesystem::create_symlink(name_, link_);
  name_ = link_;
}

void EmulatedPort::plug_tcp() {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0) refuse("TCP");
  const int yes = 1;
  setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(tcp_port_);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(listener_, generic, size) != 0 || ::listen(listener_, 1) != 0 || getsockname(listener_, generic, &size) != 0)
    refuse("TCP port " + std::to_string(tcp_port_));
  tcp_port_ = ntohs(address.sin_port);
  name_ = "tcp:127.0.0.1:" + std::to_string(tcp_port_);
}

void EmulatedPort::unplug() noexcept {
  const bool was_plugged = host_ >= 0;
  close_if_open(device_);
  close_if_open(host_);
  close_if_open(listener_);
  std::error_code ignored;
  if (was_plugged && !link_.empty()) std::filesystem::remove(link_, ignored);
}

void EmulatedPort::accept_host() noexcept {
  const int host = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (host < 0) return;
  close_if_open(device_);
  device_ = host;
}

unsigned EmulatedPort::baud_rate() const noexcept {
  return host_ < 0 ? 0 : bridges::baud_rate(host_);
}

void EmulatedPort::add_to(std::vector<pollfd>& waiting) const {
  for (const int descriptor : {device_, listener_}) {
    if (descriptor >= 0) waiting.push_back({descriptor, POLLIN, 0});
  }
}

std::string EmulatedPort::read() {
  if (listener_ >= 0) accept_host();
  if (device_ < 0) return {};
  std::array<char, 4096> bytes;
  const ssize_t size = ::read(device_, bytes.data(), bytes.size());
  if (size > 0) return {bytes.data(), static_cast<std::size_t>(size)};
  if (is_tcp_ && (size == 0 || errno != EAGAIN)) close_if_open(device_);
  return {};
}

void EmulatedPort::write(std::string_view bytes) noexcept {
  if (device_ < 0) return;
  if (is_tcp_) {
    send(device_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  } else if (::write(device_, bytes.data(), bytes.size()) < 0) {
    return;  // nobody reads
  }
}

}  // namespace glissade::bridges

#include "lcm/lcm_url.h"

#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace glissade::devices {
namespace {

constexpr std::string_view kMemq = "memq://";
constexpr std::string_view kUdpm = "udpm://";

[[noreturn]] void refuse(const std::string& url, const std::string& reason) {
  throw std::invalid_argument("The LCM address '" + url + "' does not work: " + reason + ".");
}

std::optional<long> parse_integer(std::string_view text, long low, long high) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high) return std::nullopt;
  return value;
}

void read_option(const std::string& url, std::string_view option, UdpmAddress& address) {
  const std::size_t equals = option.find('=');
  const std::string_view key = option.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? std::string_view{} : option.substr(equals + 1);
  constexpr long kLargestTtl = 255;
  constexpr long kLargestBuffer = 1L << 30;
  if (key == "ttl") {
    const std::optional<long> ttl = parse_integer(value, 0, kLargestTtl);
    if (!ttl) refuse(url, "ttl must be a whole number from 0 to 255");
    address.ttl = static_cast<int>(*ttl);
  } else if (key == "recv_buf_size") {
    const std::optional<long> size = parse_integer(value, 1, kLargestBuffer);
    if (!size) refuse(url, "recv_buf_size must be a whole number from 1 to 2^30");
    address.buffer_size = static_cast<int>(*size);
  } else {
    refuse(url, "there is no option '" + std::string(key) + "'");
  }
}

void read_options(const std::string& url, std::string_view options, UdpmAddress& address) {
  for (;;) {
    const std::size_t separator = options.find('&');
    read_option(url, options.substr(0, separator), address);
    if (separator == std::string_view::npos) return;
    options.remove_prefix(separator + 1);
  }
}

/// Connecting a UDP socket looks for a route and sends nothing.
void check_route(const std::string& url, const sockaddr_in& address) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) refuse(url, std::string("no socket: ") + std::strerror(errno));
  sockaddr generic{};
  std::memcpy(&generic, &address, sizeof(generic));
  const int error = connect(fd, &generic, sizeof(address)) == 0 ? 0 : errno;
  close(fd);
  if (error != 0) refuse(url, std::string("this machine cannot send to it (") + std::strerror(error) + ")");
}

UdpmAddress read_udpm(const std::string& url) {
  UdpmAddress address;
  std::string_view rest = std::string_view(url).substr(kUdpm.size());
  const std::size_t question = rest.find('?');
  if (question != std::string_view::npos) read_options(url, rest.substr(question + 1), address);
  rest = rest.substr(0, question);

  const std::size_t colon = rest.find(':');
  address.group.sin_family = AF_INET;
  if (inet_pton(AF_INET, std::string(rest.substr(0, colon)).c_str(), &address.group.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(address.group.sin_addr.s_addr))) {
    refuse(url, "it needs an IPv4 multicast address, 224.0.0.0 to 239.255.255.255");
  }
  constexpr long kLargestPort = 65535;
  const auto port =
      colon == std::string_view::npos ? std::nullopt : parse_integer(rest.substr(colon + 1), 1, kLargestPort);
  if (!port) refuse(url, "it needs a port from 1 to 65535 after the address");
  address.group.sin_port = htons(static_cast<std::uint16_t>(*port));
  check_route(url, address.group);
  return address;
}

}  // namespace

std::optional<UdpmAddress> check_lcm_url(const std::string& url) {
  if (url == kMemq) return std::nullopt;
  if (!url.starts_with(kUdpm)) refuse(url, "only memq:// and udpm://ADDRESS:PORT are known");
  return read_udpm(url);
}

}  // namespace glissade::devices

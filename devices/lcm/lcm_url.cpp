#include "lcm/lcm_url.h"

#include <charconv>
#include <cstring>
#include <optional>
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

void check_option(const std::string& url, std::string_view option) {
  const std::size_t equals = option.find('=');
  const std::string_view key = option.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? std::string_view{} : option.substr(equals + 1);
  constexpr long kLargestTtl = 255;
  constexpr long kLargestBuffer = 1L << 30;
  if (key == "ttl") {
    if (!parse_integer(value, 0, kLargestTtl)) refuse(url, "ttl must be a whole number from 0 to 255");
  } else if (key == "recv_buf_size") {
    if (!parse_integer(value, 1, kLargestBuffer)) refuse(url, "recv_buf_size must be a whole number from 1 to 2^30");
  } else {
    refuse(url, "there is no option '" + std::string(key) + "'");
  }
}

void check_options(const std::string& url, std::string_view options) {
  for (;;) {
    const std::size_t separator = options.find('&');
    check_option(url, options.substr(0, separator));
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

void check_udpm(const std::string& url) {
  std::string_view rest = std::string_view(url).substr(kUdpm.size());
  const std::size_t question = rest.find('?');
  if (question != std::string_view::npos) check_options(url, rest.substr(question + 1));
  rest = rest.substr(0, question);

  const std::size_t colon = rest.find(':');
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (inet_pton(AF_INET, std::string(rest.substr(0, colon)).c_str(), &address.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(address.sin_addr.s_addr))) {
    refuse(url, "it needs an IPv4 multicast address, 224.0.0.0 to 239.255.255.255");
  }
  constexpr long kLargestPort = 65535;
  const auto port =
      colon == std::string_view::npos ? std::nullopt : parse_integer(rest.substr(colon + 1), 1, kLargestPort);
  if (!port) refuse(url, "it needs a port from 1 to 65535 after the address");
  address.sin_port = htons(static_cast<std::uint16_t>(*port));
  check_route(url, address);
}

}  // namespace

LcmProvider check_lcm_url(const std::string& url) {
  if (url == kMemq) return LcmProvider::kMemq;
  if (!url.starts_with(kUdpm)) refuse(url, "only memq:// and udpm://ADDRESS:PORT are known");
  check_udpm(url);
  return LcmProvider::kUdpm;
}

}  // namespace glissade::devices

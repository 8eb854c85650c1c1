#pragma once

/// A socket that sends any bytes from any address of this machine, and packets of LCM by hand.

#include <cstdint>
#include <cstring>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace glissade::test_support {

class RawSender {
 public:
  /// Sends from `own`, or from the address that the routes choose for 0.0.0.0.
  explicit RawSender(const char* own) : fd_(socket(AF_INET, SOCK_DGRAM, 0)) {
    const sockaddr address = address_of(own, 0);
    EXPECT_EQ(bind(fd_, &address, sizeof(address)), 0);
  }
  ~RawSender() { close(fd_); }
  RawSender(const RawSender&) = delete;
  RawSender& operator=(const RawSender&) = delete;

  void send(const std::string& bytes, const char* to, int port) const {
    const sockaddr target = address_of(to, port);
    EXPECT_EQ(sendto(fd_, bytes.data(), bytes.size(), 0, &target, sizeof(target)), static_cast<ssize_t>(bytes.size()));
  }

 private:
  static sockaddr address_of(const char* ip, int port) {
    sockaddr_in internet{};
    internet.sin_family = AF_INET;
    internet.sin_port = htons(static_cast<std::uint16_t>(port));
    EXPECT_EQ(inet_pton(AF_INET, ip, &internet.sin_addr), 1);
    sockaddr result{};
    std::memcpy(&result, &internet, sizeof(result));
    return result;
  }

  int fd_;
};

inline std::string small_message(const std::string& channel, const std::string& text) {
  return std::string("LC02\0\0\0\0", 8) + channel + '\0' + text;
}

/// Fragment 0 of 100 of a message of 100,000 bytes, to be written 256 bytes before its beginning.
inline std::string hostile_fragment(const std::string& channel) {
  return std::string("LC03\0\0\0\x01\x00\x01\x86\xa0\xff\xff\xff\x00\0\0\0\x64", 20) + channel + '\0' +
         std::string(1000, 'x');
}

}  // namespace glissade::test_support

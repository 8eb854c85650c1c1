#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>

#include "eventually.h"

namespace glissade::devices {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=200000";

class Udpm : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("GLISSADE_NETWORK_NAMESPACE") == nullptr) {
      GTEST_SKIP() << "sends multicast, so it runs only under scripts/in_network_namespace";
    }
  }
};

/// A socket that sends whatever it is told, from an address of this machine.
class Attacker {
 public:
  explicit Attacker(const char* from) : fd_(socket(AF_INET, SOCK_DGRAM, 0)) {
    const sockaddr own = address(from, 0);
    EXPECT_EQ(bind(fd_, &own, sizeof(own)), 0);
  }
  ~Attacker() { close(fd_); }
  Attacker(const Attacker&) = delete;
  Attacker& operator=(const Attacker&) = delete;

  void send(const std::string& bytes, const char* to) const {
    const sockaddr target = address(to, 7667);
    EXPECT_EQ(sendto(fd_, bytes.data(), bytes.size(), 0, &target, sizeof(target)), static_cast<ssize_t>(bytes.size()));
  }

 private:
  static sockaddr address(const char* ip, std::uint16_t port) {
    sockaddr_in internet{};
    internet.sin_family = AF_INET;
    internet.sin_port = htons(port);
    EXPECT_EQ(inet_pton(AF_INET, ip, &internet.sin_addr), 1);
    sockaddr result{};
    std::memcpy(&result, &internet, sizeof(result));
    return result;
  }

  int fd_;
};

std::string small_message(const std::string& text) {
  return std::string("LC02\0\0\0\0TEST\0", 13) + text;
}

constexpr const char* kGroup = "239.255.76.67";

TEST_F(Udpm, OnlyPacketsToTheGroupFromThisMachineArrive) {
  LcmBus bus(kUrl);
  std::atomic<int> good{0};
  std::atomic<int> bad{0};
  const auto subscription = bus.subscribe("TEST", [&](std::span<const std::uint8_t> message) {
    ++(std::string(message.begin(), message.end()) == "good" ? good : bad);
  });
  const Attacker insider("0.0.0.0");  // from the address that this machine's routes choose
  const Attacker outsider("127.0.0.5");
  insider.send(small_message("unicast"), "127.0.0.1");
  insider.send(small_message("unicast"), "127.0.0.2");
  insider.send(small_message("another group"), "239.255.76.68");
  outsider.send(small_message("from elsewhere"), kGroup);
  insider.send(small_message("good"), kGroup);
  ASSERT_TRUE(eventually([&] { return good == 1; }));
  EXPECT_EQ(bad, 0);
  EXPECT_EQ(bus.refused_packets(), 1U) << "the others do not even reach the socket";
}

// Fragment 0 of 100 of a message of 100,000 bytes, to be written 256 bytes before its beginning.
TEST_F(Udpm, AFragmentThatPointsOutsideItsMessageDoesNoHarm) {
  LcmBus bus(kUrl);
  std::atomic<int> received{0};
  const auto subscription = bus.subscribe("TEST", [&](std::span<const std::uint8_t>) { ++received; });
  const Attacker attacker("0.0.0.0");
  const std::string head("LC03\0\0\0\x01\x00\x01\x86\xa0\xff\xff\xff\x00\0\0\0\x64TEST\0", 25);
  attacker.send(head + std::string(1000, 'x'), kGroup);
  attacker.send(small_message("good"), kGroup);
  ASSERT_TRUE(eventually([&] { return received == 1; }));
  EXPECT_EQ(bus.refused_packets(), 1U);
}

TEST_F(Udpm, ProgramsOfLcmReceiveWhatTheBusSends) {
  const std::unique_ptr<lcm_t, decltype(&lcm_destroy)> spy(lcm_create(kUrl), &lcm_destroy);
  int received = 0;
  lcm_subscribe(
      spy.get(), "TEST",
      [](const lcm_recv_buf_t* buffer, const char*, void* count) {
        *static_cast<int*>(count) += buffer->data_size == 3 ? 1 : 0;
      },
      &received);
  LcmBus bus(kUrl);
  const std::uint8_t message[] = {1, 2, 3};
  ASSERT_TRUE(bus.publish("TEST", message));
  ASSERT_GT(lcm_handle_timeout(spy.get(), 5000), 0);
  EXPECT_EQ(received, 1);
}

// Two connections that share nothing but the network, as two processes would.
TEST_F(Udpm, StatesAndCommandsCross) {
  const DeviceDescriptor descriptor = simulated_glove_descriptor();
  LcmGlove glove(std::make_shared<LcmBus>(kUrl), descriptor);
  LcmGloveHost host(std::make_shared<LcmBus>(kUrl), descriptor, {.patience_periods = 200.0});
  SafetyEnvelope envelope(descriptor, 200.0);
  realtime::SteadyClock clock;

  GloveState sent;
  GloveState received;
  GloveCommand command;
  command.f_H_W.z() = 2.0;
  ASSERT_TRUE(eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ++sent.sequence;
    sent.time = clock.now();
    sent.X_WH.translation().x() = 0.001 * static_cast<double>(sent.sequence % 5);
    host.publish(sent);
    if (glove.read(received)) {
      ++command.sequence;
      command.state_time = received.time;
      glove.command(envelope.limit(command, received, clock.now()));
    }
    return host.newest_command(sent).values().f_H_W.z() == 2.0;
  })) << glove.commands_sent()
      << " commands were sent, the host has accepted " << host.statistics().accepted << " and rejected "
      << host.statistics().rejected();
  EXPECT_LE(received.sequence, sent.sequence);
  EXPECT_EQ(received.X_WH.translation().x(), 0.001 * static_cast<double>(received.sequence % 5));
  EXPECT_EQ(glove.statistics().rejected() + host.statistics().rejected(), 0U);
}

}  // namespace
}  // namespace glissade::devices

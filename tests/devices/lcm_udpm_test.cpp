#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>

#include "eventually.h"
#include "raw_sender.h"

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

constexpr const char* kGroup = "239.255.76.67";
constexpr int kPort = 7667;

TEST_F(Udpm, OnlyPacketsToTheGroupFromThisMachineArrive) {
  LcmBus bus(kUrl);
  std::atomic<int> good{0};
  std::atomic<int> bad{0};
  const auto subscription = bus.subscribe("TEST", [&](std::span<const std::uint8_t> message) {
    ++(std::string(message.begin(), message.end()) == "good" ? good : bad);
  });
  const test_support::RawSender insider("0.0.0.0");
  const test_support::RawSender outsider("127.0.0.5");
  insider.send(test_support::small_message("TEST", "unicast"), "127.0.0.1", kPort);
  insider.send(test_support::small_message("TEST", "unicast"), "127.0.0.2", kPort);
  insider.send(test_support::small_message("TEST", "another group"), "239.255.76.68", kPort);
  outsider.send(test_support::small_message("TEST", "from elsewhere"), kGroup, kPort);
  insider.send(test_support::small_message("TEST", "good"), kGroup, kPort);
  ASSERT_TRUE(eventually([&] { return good == 1; }));
  EXPECT_EQ(bad, 0);
  EXPECT_EQ(bus.refused_packets(), 1U) << "the others do not even reach the socket";
}

TEST_F(Udpm, AFragmentThatPointsOutsideItsMessageDoesNoHarm) {
  LcmBus bus(kUrl);
  std::atomic<int> received{0};
  const auto subscription = bus.subscribe("TEST", [&](std::span<const std::uint8_t>) { ++received; });
  const test_support::RawSender attacker("0.0.0.0");
  attacker.send(test_support::hostile_fragment("TEST"), kGroup, kPort);
  attacker.send(test_support::small_message("TEST", "good"), kGroup, kPort);
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
TEST_F(Udpm, StatesAndCommandsArriveAtTheOtherEnd) {
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

#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>

#include "eventually.h"

namespace glissade::devices {
namespace {

// Two connections that share nothing but the network, as two processes would.
TEST(Udpm, StatesAndCommandsCross) {
  if (std::getenv("GLISSADE_NETWORK_NAMESPACE") == nullptr) {
    GTEST_SKIP() << "sends multicast, so it runs only under scripts/in_network_namespace";
  }
  const char* const kUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=200000";
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

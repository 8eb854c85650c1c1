#include <cstdlib>
#include <memory>

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
  LcmGlove glove(std::make_shared<LcmBus>(kUrl), simulated_glove_descriptor());
  LcmGloveHost host(std::make_shared<LcmBus>(kUrl));

  GloveState sent;
  GloveState received;
  ASSERT_TRUE(eventually([&] {
    ++sent.sequence;
    sent.X_WH.translation().x() = 0.001 * static_cast<double>(sent.sequence % 100);
    host.publish(sent);
    return glove.read(received);
  }));
  EXPECT_LE(received.sequence, sent.sequence);
  EXPECT_EQ(received.X_WH.translation().x(), 0.001 * static_cast<double>(received.sequence % 100));

  GloveCommand command;
  ASSERT_TRUE(eventually([&] {
    ++command.sequence;
    command.f_H_W.z() = 2.0;
    glove.command(command);
    return host.newest_command().f_H_W.z() == 2.0;
  })) << glove.commands_sent()
      << " commands were sent, the host has accepted " << host.statistics().accepted << " and rejected "
      << host.statistics().rejected();
  EXPECT_EQ(glove.statistics().rejected() + host.statistics().rejected(), 0U);
}

}  // namespace
}  // namespace glissade::devices

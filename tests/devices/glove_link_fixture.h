#pragma once

/// The server's end of a link, and messages of a glove.

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/lcmtypes/glove_state_t.hpp>

#include "eventually.h"

namespace glissade::devices {

using Bytes = std::vector<std::uint8_t>;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();

template <typename Message>
Bytes encoded(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

inline glove_state_t good_state(std::int64_t sequence) {
  glove_state_t message{};
  message.version = glove_state_t::VERSION;
  message.device = kDefaultDevice;
  message.session = 1;
  message.enabled = 1;
  message.sequence = sequence;
  message.orientation_WH_wxyz[0] = 1.0;
  return message;
}

class LcmLink : public testing::Test {
 protected:
  /// Sends `bytes` as a glove would and returns what the link makes of them.
  LinkStatistics after(const Bytes& bytes) {
    const LinkStatistics before = glove.statistics();
    bus->publish("GLOVE_STATE", bytes);
    EXPECT_TRUE(eventually([&] {
      const LinkStatistics now = glove.statistics();
      return now.accepted + now.rejected() == before.accepted + before.rejected() + 1;
    }));
    return glove.statistics();
  }

  std::shared_ptr<LcmBus> bus = std::make_shared<LcmBus>("memq://");
  const DeviceDescriptor descriptor = simulated_glove_descriptor();
  LcmGlove glove{bus, descriptor};
};

}  // namespace glissade::devices

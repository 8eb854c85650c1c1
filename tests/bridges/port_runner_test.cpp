/// Emulated devices behind ports of this machine, as a bridge finds them.

#include "emulation/port_runner.h"

#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/bridges/serial_stream.h>
#include <glissade/bridges/wire.h>

#include "dynamixel/emulated_bus.h"
#include "dynamixel/servo_bus.h"
#include "elastic_finger.h"
#include "temporary_folder.h"

namespace glissade::bridges::dynamixel {
namespace {

constexpr unsigned kBaudRate = 3000000;

/// A port with one servo, of id 1.
std::vector<PluggedDevice> one_servo(const std::string& link) {
  const auto finger = std::make_shared<ElasticFinger>(1.0, 0.5, 0.025);
  std::vector<PluggedDevice> plugged;
  plugged.push_back({.port = EmulatedPort::terminal(link),
                     .device = std::make_shared<EmulatedBus>(
                         std::vector<EmulatedServo>{{1, *find_model("XL330-M288"), finger}}, kBaudRate),
                     .baud_rate = kBaudRate});
  return plugged;
}

std::optional<PingAnswer> ping(const std::string& port, unsigned baud_rate, std::chrono::milliseconds patience) {
  SerialStream line(port, baud_rate);
  line.open();
  realtime::SteadyClock clock;
  return ServoBus(line, clock, {.patience = patience}).ping(1);
}

TEST(PortRunner, LooksLikeAPortWithServos) {
  const PortRunner runner(one_servo(""));
  SerialStream line(runner.port(0), kBaudRate);
  line.open();
  realtime::SteadyClock clock;
  ServoBus bus(line, clock, {.patience = std::chrono::seconds(5)});
  const std::optional<PingAnswer> answer = bus.ping(1);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->model, 1200);
  // Bytes that a terminal could change or swallow.
  for (int value = 0; value < 255; ++value) {
    const std::string data = encode_register(kPositionDGain, 0x0300 + value);
    ASSERT_TRUE(bus.write(1, kPositionDGain.address, data)) << value;
    ASSERT_EQ(bus.read(1, kPositionDGain.address, 2)->data, data);
  }
}

TEST(PortRunner, DeviceUnderstandsItsBaudRateOnly) {
  const PortRunner runner(one_servo(""));
  EXPECT_FALSE(ping(runner.port(0), 57600, std::chrono::milliseconds(50)));
  EXPECT_TRUE(ping(runner.port(0), kBaudRate, std::chrono::seconds(5)));
}

TEST(PortRunner, PortVanishesAndComesBackUnderItsLink) {
  const test_support::TemporaryFolder folder;
  PortRunner runner(one_servo(folder.path("servos")));
  EXPECT_EQ(runner.port(0), folder.path("servos"));
  runner.unplug();
  EXPECT_THROW(ping(folder.path("servos"), kBaudRate, std::chrono::milliseconds(50)), WireError);
  runner.plug();
  EXPECT_TRUE(ping(folder.path("servos"), kBaudRate, std::chrono::seconds(5)));
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

/// `glissade bridge dynamixel` as a process, between emulated servos and a server that stops a finger.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/dynamixel_emulator.h>

#include "limiting_server.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::size_t kIndexDip = 6;
constexpr const char* kTwoServos = R"(name: two fingers
model: XL330-M288
servos:
  - {id: 1, joint: index_dip, zero_rad: 3.14}
  - {id: 2, joint: middle_dip, zero_rad: 3.14}
)";

class DynamixelBridgeProcess : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    folder.write("glove.yaml", kTwoServos);
    hand = bridges::read_dynamixel_hand(folder.path("glove.yaml"));
    const auto fist = [](std::chrono::nanoseconds time) {
      const double curl = std::min(1.0, std::chrono::duration<double>(time).count());
      return bridges::angles_of({curl, curl, curl, curl, curl});
    };
    glove = std::make_unique<bridges::DynamixelEmulator>(
        hand, bridges::DynamixelEmulatorOptions{.link = folder.path("servos"), .wearer = fist});
    bridge = std::make_unique<test_support::Process>(
        std::vector<std::string>{GLISSADE_PROGRAM, "bridge", "dynamixel", "--config", folder.path("glove.yaml"),
                                 "--port", folder.path("servos"), "--lcm", test_support::kUrl});
    server = std::make_unique<LimitingServer>(bridges::descriptor_of(hand), kIndexDip);
  }

  /// The wearer makes a fist, and the limit is in the middle of the way.
  bool is_held() const {
    return time_until([&] { return std::abs(glove->servos()[0].torque) > 0.02; }) < std::chrono::seconds(10);
  }
  std::chrono::duration<double> time_until_free() const {
    return time_until([&] { return !glove->servos()[0].has_torque; });
  }
  void wait_until_bridge_says(const std::string& text) const {
    time_until([&] { return bridge->standard_error().find(text) != std::string::npos; });
    EXPECT_THAT(bridge->standard_error(), HasSubstr(text));
  }

  const test_support::TemporaryFolder folder;
  bridges::DynamixelHand hand;
  std::unique_ptr<bridges::DynamixelEmulator> glove;
  std::unique_ptr<test_support::Process> bridge;
  std::unique_ptr<LimitingServer> server;
};

TEST_F(DynamixelBridgeProcess, HoldsOneFingerAndLeavesTheOthers) {
  ASSERT_TRUE(is_held()) << bridge->standard_error();
  constexpr double kFarther_rad = 0.3;  // of about 0.6 rad from the middle of the way to the fist
  const auto is_behind = [&] { return glove->servos()[0].angle < glove->servos()[1].angle - kFarther_rad; };
  EXPECT_LT(time_until(is_behind), std::chrono::seconds(10));
  EXPECT_FALSE(glove->servos()[1].has_torque);
}

TEST_F(DynamixelBridgeProcess, TurnsTheTorqueOffAlthoughItIsKilled) {
  ASSERT_TRUE(is_held()) << bridge->standard_error();
  bridge->signal(SIGKILL);
  EXPECT_LT(time_until_free(), milliseconds(100));
  EXPECT_EQ(bridge->wait().exit_code, -SIGKILL);
}

TEST_F(DynamixelBridgeProcess, TurnsTheTorqueOffAlthoughItHangs) {
  ASSERT_TRUE(is_held()) << bridge->standard_error();
  bridge->signal(SIGSTOP);
  EXPECT_LT(time_until_free(), milliseconds(200));
  bridge->signal(SIGCONT);
  EXPECT_TRUE(is_held()) << "it goes on";
}

TEST_F(DynamixelBridgeProcess, TurnsTheTorqueOffWhenTheServerIsSilent) {
  ASSERT_TRUE(is_held()) << bridge->standard_error();
  server->fall_silent();
  EXPECT_LT(time_until_free(), milliseconds(100));
}

TEST_F(DynamixelBridgeProcess, EndsWithinASecondAndTurnsTheTorqueOff) {
  ASSERT_TRUE(is_held()) << bridge->standard_error();
  const auto start = std::chrono::steady_clock::now();
  bridge->signal(SIGINT);
  const test_support::ProgramResult result = bridge->wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_FALSE(glove->servos()[0].has_torque);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.standard_output, HasSubstr("the fingers are free"));
}

TEST_F(DynamixelBridgeProcess, ComesBackEachTimeTheAdapterIsPluggedInAgain) {
  std::mt19937 random(3);
  constexpr int kTimes = 4;
  for (int i = 0; i < kTimes; ++i) {
    ASSERT_TRUE(is_held()) << i << ": " << bridge->standard_error();
    std::this_thread::sleep_for(milliseconds(random() % 200));
    glove->unplug();
    // The bus watchdog stops the servo, which then holds its place: the bridge finds it so when it is back.
    std::this_thread::sleep_for(milliseconds(random() % 500));
    glove->plug();
  }
  ASSERT_TRUE(is_held()) << bridge->standard_error();
  wait_until_bridge_says("the device is back");
}

}  // namespace
}  // namespace glissade::apps

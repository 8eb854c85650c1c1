/// `glissade bridge opengloves` as a process, between an emulated glove and a server that stops its index finger.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/opengloves_emulator.h>
#include <glissade/bridges/opengloves_wire.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/clock.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kIndexMcp = 4;

/// A server that answers each state of the glove with a limit of the index finger, in the middle of its way.
class LimitingServer {
 public:
  LimitingServer() : thread_([this](const std::stop_token& stop) { serve(stop); }) {}

 private:
  void serve(const std::stop_token& stop) {
    const auto descriptor = bridges::opengloves_descriptor();
    devices::LcmGlove glove(std::make_shared<devices::LcmBus>(test_support::kUrl), descriptor);
    devices::SafetyEnvelope envelope(descriptor);
    realtime::SteadyClock clock;
    for (std::int64_t sequence = 1; !stop.stop_requested(); ++sequence) {
      std::this_thread::sleep_for(milliseconds(2));
      devices::GloveState state;
      if (!glove.read(state)) continue;
      devices::GloveCommand wanted;
      wanted.sequence = sequence;
      wanted.state_sequence = state.sequence;
      wanted.state_time = state.time;
      wanted.time = clock.now();
      wanted.joint_limits.joints[kIndexMcp] = {.upper = 0.5 * descriptor.joint_upper[kIndexMcp],
                                               .stiffness = descriptor.max_limit_stiffness,
                                               .max_torque = descriptor.max_joint_torque};
      glove.command(envelope.limit(wanted, state, clock.now()));
    }
  }

  std::jthread thread_;
};

/// How long it takes until `condition` holds, at most ten seconds.
template <typename Condition>
std::chrono::duration<double> time_until(Condition condition) {
  const auto start = std::chrono::steady_clock::now();
  while (!condition() && std::chrono::steady_clock::now() - start < std::chrono::seconds(10))
    std::this_thread::sleep_for(milliseconds(1));
  return std::chrono::steady_clock::now() - start;
}

class BridgeProcess : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    bridges::EmulatorOptions options;
    options.link = folder.path("glove");
    options.wearer = [](std::chrono::nanoseconds) { return bridges::FingerValues{}; };
    glove = std::make_unique<bridges::OpenGlovesEmulator>(options);
    bridge = std::make_unique<test_support::Process>(std::vector<std::string>{
        GLISSADE_PROGRAM, "bridge", "opengloves", "--port", options.link, "--lcm", test_support::kUrl});
  }

  int limit() const { return glove->state().limits[1]; }
  bool is_stopped_at_the_middle() const {
    return time_until([&] { return limit() > 450; }) < std::chrono::seconds(10);
  }
  std::chrono::duration<double> time_until_free() const {
    return time_until([&] { return limit() == 0; });
  }

  const test_support::TemporaryFolder folder;
  std::unique_ptr<bridges::OpenGlovesEmulator> glove;
  std::unique_ptr<test_support::Process> bridge;
  LimitingServer server;
};

TEST_F(BridgeProcess, ReleasesTheServosAlthoughItIsKilled) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  bridge->signal(SIGKILL);
  EXPECT_LT(time_until_free(), milliseconds(100));
  EXPECT_EQ(bridge->wait().exit_code, -SIGKILL);
}

TEST_F(BridgeProcess, ReleasesTheServosAlthoughItHangs) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  bridge->signal(SIGSTOP);
  EXPECT_LT(time_until_free(), milliseconds(200));
  bridge->signal(SIGCONT);
  EXPECT_TRUE(is_stopped_at_the_middle());
}

TEST_F(BridgeProcess, EndsWithinASecondAndReleasesTheServos) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  const auto start = std::chrono::steady_clock::now();
  bridge->signal(SIGINT);
  const test_support::ProgramResult result = bridge->wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_EQ(limit(), 0);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.standard_output, testing::HasSubstr("the fingers are free"));
  EXPECT_THAT(result.standard_error, testing::HasSubstr("the device is connected"));
}

TEST_F(BridgeProcess, ComesBackWhenTheGloveIsPluggedInAgain) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  glove->unplug();
  time_until([&] { return bridge->standard_error().find("unplugged") != std::string::npos; });
  glove->plug();
  time_until([&] { return bridge->standard_error().find("the device is back") != std::string::npos; });
  EXPECT_THAT(bridge->standard_error(), testing::HasSubstr("the device is back"));
  const auto lines = glove->state().limit_lines;
  EXPECT_LT(time_until([&] { return glove->state().limit_lines > lines + 5; }), std::chrono::seconds(10));
}

}  // namespace
}  // namespace glissade::apps

/// `glissade bridge opengloves` as a process, between an emulated glove and a server that stops its index finger.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/opengloves_emulator.h>
#include <glissade/bridges/opengloves_wire.h>

#include "limiting_server.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kIndexMcp = 4;

class OpenGlovesBridgeProcess : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    bridges::OpenGlovesEmulatorOptions options;
    options.link = folder.path("glove");
    options.wearer = [](std::chrono::nanoseconds) { return bridges::angles_of({}); };
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
  LimitingServer server{bridges::opengloves_descriptor(), kIndexMcp};
};

TEST_F(OpenGlovesBridgeProcess, ReleasesTheServosAlthoughItIsKilled) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  bridge->signal(SIGKILL);
  EXPECT_LT(time_until_free(), milliseconds(100));
  EXPECT_EQ(bridge->wait().exit_code, -SIGKILL);
}

TEST_F(OpenGlovesBridgeProcess, ReleasesTheServosAlthoughItHangs) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  bridge->signal(SIGSTOP);
  EXPECT_LT(time_until_free(), milliseconds(200));
  bridge->signal(SIGCONT);
  EXPECT_TRUE(is_stopped_at_the_middle());
}

TEST_F(OpenGlovesBridgeProcess, ReleasesTheServosWhenTheServerIsSilent) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  server.fall_silent();
  EXPECT_LT(time_until_free(), milliseconds(100));
}

TEST_F(OpenGlovesBridgeProcess, EndsWithinASecondAndReleasesTheServos) {
  ASSERT_TRUE(is_stopped_at_the_middle()) << bridge->standard_error();
  const auto start = std::chrono::steady_clock::now();
  bridge->signal(SIGINT);
  const test_support::ProgramResult result = bridge->wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_LT(time_until_free(), milliseconds(100)) << "the firmware reads a line a state";
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.standard_output, testing::HasSubstr("the fingers are free"));
  EXPECT_THAT(result.standard_error, testing::HasSubstr("the device is connected"));
}

TEST_F(OpenGlovesBridgeProcess, ComesBackWhenTheGloveIsPluggedInAgain) {
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

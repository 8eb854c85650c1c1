/// From an emulated glove through its bridge to a server and back, all as processes: a hand takes a ball, the fingers
/// stop at it, and the hand lets go. Also with a bad wire.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limiting_server.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::Process;
using testing::HasSubstr;

class GraspThroughABridge : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    ASSERT_EQ(Process({"/bin/sh", "-c", "cd '" + folder.path("") + "' && '" + GLISSADE_PROGRAM + "' example"})
                  .wait()
                  .exit_code,
              0);
  }

  /// Runs the emulator, the bridge and the server until the hand has let go of the ball, for at most half a minute.
  void grasp(std::vector<std::string> emulator, std::vector<std::string> bridge) {
    emulator.insert(emulator.begin(), {GLISSADE_PROGRAM, "emulate"});
    bridge.insert(bridge.begin(), {GLISSADE_PROGRAM, "bridge"});
    bridge.insert(bridge.end(), {"--position-m", "-0.095", "0", "0.1", "--lcm", test_support::kUrl});
    Process device(emulator);
    Process between(bridge);
    Process server({GLISSADE_PROGRAM, "run", folder.path("ball_and_tray.yaml"), "--fingers", "--lcm",
                    test_support::kUrl, "--seconds", "30"});
    const auto has_let_go = [&] { return server.standard_error().find("lets go of 'ball'") != std::string::npos; };
    for (int i = 0; i < 3 && !has_let_go(); ++i)
      time_until(has_let_go);
    EXPECT_THAT(server.standard_error(), HasSubstr("takes 'ball'")) << between.standard_error();
    EXPECT_THAT(server.standard_error(), HasSubstr("lets go of 'ball'"));
    between.signal(SIGINT);
    EXPECT_THAT(between.wait().standard_output, HasSubstr("the fingers are free"));
    device.signal(SIGINT);
    told = device.wait().standard_output;
  }

  const test_support::TemporaryFolder folder;
  std::string told;  ///< by the emulator, at its end
};

TEST_F(GraspThroughABridge, OpenGlovesFingersStopAtABall) {
  grasp({"opengloves", "--link", folder.path("glove")}, {"opengloves", "--port", folder.path("glove")});
  EXPECT_THAT(told, testing::Not(HasSubstr(" 0 of them stop a finger")));
}

TEST_F(GraspThroughABridge, OpenGlovesWorksOnABadWire) {
  grasp({"opengloves", "--link", folder.path("glove"), "--fault", "garbage", "cut", "echo"},
        {"opengloves", "--port", folder.path("glove")});
}

TEST_F(GraspThroughABridge, ServosHoldFingersAtABall) {
  grasp({"dynamixel", "--preset", "doglove", "--link", folder.path("servos"), "--board-link", folder.path("board")},
        {"dynamixel", "--preset", "doglove", "--port", folder.path("servos"), "--board-port", folder.path("board")});
  EXPECT_THAT(told, testing::Not(HasSubstr("greatest torque of a servo 0.00 Nm")));
  EXPECT_THAT(told, HasSubstr(" 0 servos have torque at the end"));
}

TEST_F(GraspThroughABridge, ServosWorkOnABadWire) {
  grasp({"dynamixel", "--preset", "doglove", "--link", folder.path("servos"), "--board-link", folder.path("board"),
         "--fault", "garbage", "wrong-bits", "echo"},
        {"dynamixel", "--preset", "doglove", "--port", folder.path("servos"), "--board-port", folder.path("board")});
}

}  // namespace
}  // namespace glissade::apps

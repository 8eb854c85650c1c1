/// `glissade calibrate` as a process, with the bridge of an emulated glove whose wearer shows the poses that it asks
/// for.

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/calibration_poses.h>
#include <glissade/bridges/opengloves_emulator.h>
#include <glissade/bridges/opengloves_wire.h>
#include <glissade/devices/hand_pose.h>
#include <glissade/devices/lcm_glove.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::size_t kKnuckle = 4;
constexpr double kFist_rad = 80.0 * M_PI / 180.0;

/// The strings of this wearer's glove go from 0.1 to 0.8 only. The fingers that touch are half closed.
bridges::FingerValues curls_of(std::size_t pose) {
  constexpr double kOpen = 0.1;
  constexpr double kClosed = 0.8;
  bridges::FingerValues curls;
  curls.fill(pose == 1 ? kClosed : kOpen);
  const bool is_thumb_to_finger = pose >= 2 && pose <= 5;
  if (is_thumb_to_finger) curls[0] = curls[pose - 1] = 0.5 * (kOpen + kClosed);
  return curls;
}

class CalibrateProcess : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    bridges::OpenGlovesEmulatorOptions options;
    options.link = folder.path("glove");
    options.wearer = [this](std::chrono::nanoseconds) { return bridges::angles_of(curls_of(pose)); };
    glove = std::make_unique<bridges::OpenGlovesEmulator>(options);
  }

  std::unique_ptr<test_support::Process> bridge(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{GLISSADE_PROGRAM,     "bridge", "opengloves",      "--port",
                                       folder.path("glove"), "--lcm",  test_support::kUrl};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<test_support::Process>(arguments);
  }

  /// Runs the command, while the wearer does what it asks for.
  test_support::ProgramResult calibrate(const std::string& out) {
    test_support::Process command({GLISSADE_PROGRAM, "calibrate", "--lcm", test_support::kUrl, "--user", "anna",
                                   "--out", out, "--pause-s", "1", "--hold-s", "0.5"});
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (std::size_t asked = 1; asked <= bridges::kCalibrationPoses;) {
      std::this_thread::sleep_for(milliseconds(5));
      const std::string said = command.standard_error();
      if (said.find("pose " + std::to_string(asked) + " of 7") != std::string::npos) pose = asked++ - 1;
      if (std::chrono::steady_clock::now() > end) break;
    }
    return command.wait();
  }

  const test_support::TemporaryFolder folder;
  std::atomic<std::size_t> pose{0};
  std::unique_ptr<bridges::OpenGlovesEmulator> glove;
};

TEST_F(CalibrateProcess, MakesTheFileWithWhichTheBridgeTellsTheFist) {
  const std::string file = folder.path("anna.yaml");
  auto raw = bridge();
  const test_support::ProgramResult result = calibrate(file);
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_THAT(result.standard_output, HasSubstr("index_mcp"));
  EXPECT_THAT(result.standard_output, HasSubstr("--calibration " + file));
  raw->signal(SIGINT);
  raw->wait();

  pose = 1;
  const auto calibrated = bridge({"--calibration", file});
  const auto bus = std::make_shared<devices::LcmBus>(test_support::kUrl);
  const auto info = devices::GloveSearch(bus).wait_for(devices::kDefaultDevice, std::chrono::seconds(10));
  ASSERT_TRUE(info) << calibrated->standard_error();
  EXPECT_TRUE(info->is_calibrated);
  devices::LcmGlove server(bus, info->descriptor);
  devices::GloveState state;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::abs(state.joint_angles[kKnuckle] - kFist_rad) > 0.03 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(milliseconds(10));
    server.read(state);
  }
  EXPECT_NEAR(state.joint_angles[kKnuckle], kFist_rad, 0.03) << "0.8 of the way before the calibration";

  test_support::Process second({GLISSADE_PROGRAM, "calibrate", "--lcm", test_support::kUrl, "--user", "anna", "--out",
                                folder.path("again.yaml")});
  const test_support::ProgramResult again = second.wait();
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.standard_error, HasSubstr("calibrated already"));
}

TEST_F(CalibrateProcess, JoinsATrackerToTheFingers) {
  const auto joined = bridge({"--pose-from", "lcm:4"});
  const auto bus = std::make_shared<devices::LcmBus>(test_support::kUrl);
  devices::HandPosePublisher tracker(bus, 4);
  devices::LcmGlove server(bus, bridges::opengloves_descriptor());
  devices::TrackedPose tracked;
  tracked.X_WT.translation() = Eigen::Vector3d(0.1, 0.2, 0.3);
  devices::GloveState state;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!server.read(state) && std::chrono::steady_clock::now() < end) {
    tracked.time = std::chrono::steady_clock::now().time_since_epoch();
    ++tracked.sequence;
    tracker.publish(tracked);
    std::this_thread::sleep_for(milliseconds(10));
  }
  EXPECT_TRUE(state.X_WH.translation().isApprox(tracked.X_WT.translation())) << joined->standard_error();
  EXPECT_THAT(joined->standard_error(), HasSubstr("the tracker of hand 4 is heard"));
}

}  // namespace
}  // namespace glissade::apps

/// `glissade bridge haply` as a process, between an emulated service and `glissade run`.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/bridges/haply_emulator.h>
#include <glissade/bridges/haply_wire.h>
#include <glissade/devices/glove_model.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

/// How long it takes until `condition` holds, at most twenty seconds.
template <typename Condition>
std::chrono::duration<double> wait_for(Condition condition) {
  const auto start = std::chrono::steady_clock::now();
  while (!condition() && std::chrono::steady_clock::now() - start < seconds(20))
    std::this_thread::sleep_for(milliseconds(1));
  return std::chrono::steady_clock::now() - start;
}

struct Place {
  double t_s;
  Eigen::Vector3d p_DC;
};

/// A hand that goes through these places. The world is the device.
devices::SimulatedGlove hand_through(const std::vector<Place>& places, devices::SimulatedGloveParameters parameters) {
  std::vector<geometry::TimedPose> poses;
  for (const Place& place : places) {
    const auto time = std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(place.t_s));
    poses.push_back({time, Eigen::Isometry3d(Eigen::Translation3d(place.p_DC))});
  }
  return devices::SimulatedGlove(geometry::PoseTrajectory(poses), parameters,
                                 devices::read_glove_model(bridges::kInverse3Preset));
}

constexpr bool kHoldsAtStart = true;

class HaplyProcesses : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  }

  void start(devices::SimulatedGlove hand, bool holds_at_start, const std::string& server_seconds,
             bridges::HaplyFaults faults = {}) {
    const std::string scene = folder.write("scene.yaml",
                                           "objects:\n"
                                           "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n"
                                           "  - name: box\n"
                                           "    movable: true\n"
                                           "    shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04}\n"
                                           "    pose: {position_m: [0, 0, 0.03]}\n"
                                           "goal: {position_m: [0.05, 0, 0.02]}\n");
    server = std::make_unique<test_support::Process>(std::vector<std::string>{
        GLISSADE_PROGRAM, "run", scene, "--lcm", test_support::kUrl, "--seconds", server_seconds, "--json"});
    bridges::HaplyEmulatorOptions options;
    options.hand = std::move(hand);
    options.wait = std::chrono::hours(1);
    options.port = 10451;  // no program gets it by chance while the service is not there
    options.faults = faults;
    device = std::make_unique<bridges::HaplyEmulator>(std::move(options));
    bridge = std::make_unique<test_support::Process>(std::vector<std::string>{
        GLISSADE_PROGRAM, "bridge", "haply", "--service", device->service(), "--lcm", test_support::kUrl});
    // A part that is taken later is taken elsewhere.
    const std::string ready = holds_at_start ? "the glove holds" : "device 'Inverse3'";
    wait_for([&] { return server->standard_error().find(ready) != std::string::npos; });
    device->begin_script();
  }

  double force_N() const { return device->state().f_C_D.norm(); }
  bool feels_the_contact() const {
    return wait_for([&] { return force_N() > 0.4; }) < seconds(20);
  }
  std::chrono::duration<double> time_until_free() const {
    return wait_for([&] { return force_N() == 0.0; });
  }

  const test_support::TemporaryFolder folder;
  std::unique_ptr<test_support::Process> server;
  std::unique_ptr<bridges::HaplyEmulator> device;
  std::unique_ptr<test_support::Process> bridge;
};

/// Holds the box from the start, and presses it on the plate.
devices::SimulatedGlove pressing_hand() {
  return hand_through({{0.0, {0, 0, 0.03}}, {0.5, {0, 0, 0.005}}}, {});
}

TEST_F(HaplyProcesses, AHandTakesAPartByTheButtonCarriesItToItsSeatAndLetsGo) {
  devices::SimulatedGloveParameters parameters;
  parameters.starts_closed = false;
  parameters.grip_changes = {milliseconds(4300), milliseconds(7500)};
  start(hand_through({{0.0, {0, 0, 0.1}},
                      {3.0, {0, 0, 0.1}},
                      {4.0, {0, 0, 0.03}},
                      {4.6, {0, 0, 0.03}},
                      {5.5, {0.05, 0, 0.05}},
                      {6.5, {0.05, 0, 0.01}},
                      {8.0, {0.05, 0, 0.01}},
                      {9.0, {0.05, 0, 0.1}}},
                     parameters),
        !kHoldsAtStart, "11");
  const test_support::ProgramResult result = server->wait();
  ASSERT_EQ(result.exit_code, 0) << result.standard_error << bridge->standard_error();
  const nlohmann::json summary = nlohmann::json::parse(result.standard_output);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["goal_reached"], true) << "and the hand went on alone";
  EXPECT_GT(summary["hands"][0]["force_max_N"], 0.5);
  EXPECT_NEAR(device->state().p_DC.z(), 0.1, 0.005);
  bridge->signal(SIGINT);
  EXPECT_THAT(bridge->wait().standard_output, testing::HasSubstr("the wire failed 0 times; the force is off"));
}

TEST_F(HaplyProcesses, NothingPushesTheHandAfterTheServerIsKilled) {
  start(pressing_hand(), kHoldsAtStart, "60");
  ASSERT_TRUE(feels_the_contact()) << bridge->standard_error() << server->standard_error();
  server->signal(SIGKILL);
  EXPECT_LT(time_until_free(), milliseconds(100));
}

TEST_F(HaplyProcesses, NothingPushesTheHandAfterTheBridgeIsKilledOrHangs) {
  start(pressing_hand(), kHoldsAtStart, "60");
  ASSERT_TRUE(feels_the_contact()) << bridge->standard_error() << server->standard_error();
  bridge->signal(SIGSTOP);
  EXPECT_LT(time_until_free(), milliseconds(100));
  bridge->signal(SIGCONT);
  ASSERT_TRUE(feels_the_contact()) << bridge->standard_error();
  bridge->signal(SIGKILL);
  EXPECT_LT(time_until_free(), milliseconds(100));
}

TEST_F(HaplyProcesses, EndsWithinASecondAndLetsGo) {
  start(pressing_hand(), kHoldsAtStart, "60");
  ASSERT_TRUE(feels_the_contact()) << bridge->standard_error() << server->standard_error();
  const auto start = std::chrono::steady_clock::now();
  bridge->signal(SIGINT);
  const test_support::ProgramResult result = bridge->wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(1));
  EXPECT_EQ(force_N(), 0.0);
  EXPECT_EQ(result.exit_code, 0);
}

TEST_F(HaplyProcesses, TheForceReturnsAfterTheDeviceIsPluggedInAndTheServiceIsStartedAgain) {
  start(pressing_hand(), kHoldsAtStart, "60", {.garbage = 0.002, .cut = 0.002});
  ASSERT_TRUE(feels_the_contact()) << bridge->standard_error() << server->standard_error();
  device->unplug();
  EXPECT_LT(time_until_free(), milliseconds(100));
  wait_for([&] { return bridge->standard_error().find("is it plugged in") != std::string::npos; });
  device->plug();
  EXPECT_TRUE(feels_the_contact()) << bridge->standard_error();
  device->stop_service();
  EXPECT_LT(time_until_free(), milliseconds(100));
  device->start_service();
  EXPECT_TRUE(feels_the_contact()) << bridge->standard_error();
  EXPECT_THAT(bridge->standard_error(), testing::HasSubstr("is it plugged in"));
  EXPECT_THAT(bridge->standard_error(), testing::HasSubstr("the device is back"));
}

}  // namespace
}  // namespace glissade::apps

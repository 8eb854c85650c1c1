// The server with its real threads and a device of the test's own. Nothing here depends on how fast the machine is.

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/haptics/sliding.h>

#include "allocation_counter.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A simulated glove that takes a step whenever it is read. Used by the haptic thread alone.
class SteppedDevice final : public devices::GloveDevice {
 public:
  explicit SteppedDevice(const geometry::PoseTrajectory& script) : glove_(script) {}

  const devices::DeviceDescriptor& descriptor() const noexcept override { return glove_.descriptor(); }
  bool read(devices::GloveState& newest) noexcept override {
    newest = silent_ ? glove_.state() : glove_.step(kTickPeriod, command_);
    return true;
  }
  void command(const devices::GloveCommand& command) noexcept override { command_ = command; }

  void fall_silent() { silent_ = true; }
  const devices::GloveCommand& last_command() const { return command_; }

 private:
  devices::SimulatedGlove glove_;
  devices::GloveCommand command_;
  std::atomic<bool> silent_{false};
};

class Server : public ::testing::Test {
 protected:
  Server() {
    const Isometry3d X_WH_end(Eigen::Translation3d(0.0, 0.0, 0.01));
    using std::chrono::milliseconds;
    device_ = std::make_unique<SteppedDevice>(
        geometry::PoseTrajectory({{milliseconds(0), kStart}, {milliseconds(150), X_WH_end}}));
    const Coupling coupling = coupling_for(device_->descriptor(), {1000.0, 2.0});
    sliding_ = std::make_unique<Sliding>(std::vector<Obstacle>{{plate_}}, box_, kStart,
                                         SlidingOptions{.stiffness = coupling.stiffness});
  }

  static void wait_for(const HapticServer& server) {
    while (!server.is_done())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  static inline const Isometry3d kStart{Eigen::Translation3d(0.0, 0.0, 0.03)};
  std::shared_ptr<const ContactBody> plate_ =
      std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 200)));
  std::shared_ptr<const SlidingPart> box_ = std::make_shared<SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 12)));
  std::unique_ptr<SteppedDevice> device_;
  std::unique_ptr<Sliding> sliding_;
  realtime::SteadyClock clock_;
};

TEST_F(Server, PressesThePartOnThePlateAndSendsTheForces) {
  constexpr std::size_t kTicks = 2000;  // the hand presses after 150; a slow simulation has all the rest to follow
  std::vector<devices::HapticState> samples(kTicks);
  std::size_t count = 0;
  std::int64_t allocations = 0;
  HapticServer server(*device_, *sliding_, clock_,
                      [&](const devices::HapticState& sample) {
                        samples[count++] = sample;
                        if (count == 1) allocations = test_support::allocations_of_this_thread();
                        if (count == kTicks) allocations = test_support::allocations_of_this_thread() - allocations;
                      },
                      {.ticks = kTicks});
  wait_for(server);
  server.stop();

  EXPECT_EQ(count, kTicks);
  EXPECT_GE(server.statistics().haptic.ticks, kTicks);
  EXPECT_GT(samples.back().force_on_hand_W.z(), 1.0);
  EXPECT_NEAR(samples.back().X_WV.translation().z(), 0.02, 20e-6);
  EXPECT_EQ(allocations, 0);  // of the haptic thread, from its first tick to its last
  for (const devices::HapticState& sample : samples)
    EXPECT_GT(sample.X_WV.translation().z(), 0.02);
}

TEST_F(Server, ADeviceThatFallsSilentGetsNoForce) {
  std::atomic<bool> silent{false};
  HapticServer server(*device_, *sliding_, clock_,
                      [&](const devices::HapticState& sample) {
                        if (sample.sequence == 400) device_->fall_silent();
                        if (sample.has_no_device) silent = true;
                      },
                      {.ticks = 600, .device_timeout = std::chrono::milliseconds(20)});
  wait_for(server);
  server.stop();
  EXPECT_TRUE(silent);
  EXPECT_EQ(device_->last_command().f_H_W, Vector3d::Zero());
  EXPECT_EQ(device_->last_command().t_H_W, Vector3d::Zero());
}

TEST_F(Server, RefusesAnEmptySink) {
  EXPECT_THROW(HapticServer(*device_, *sliding_, clock_, {}), std::invalid_argument);
}

TEST_F(Server, StopsWhenItIsToldTo) {
  HapticServer server(*device_, *sliding_, clock_, [](const devices::HapticState&) {});
  while (server.ticks() < 10)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.stop();
  EXPECT_FALSE(server.is_done());
  const std::int64_t ticks = server.ticks();
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(server.ticks(), ticks);
}

}  // namespace
}  // namespace glissade::haptics

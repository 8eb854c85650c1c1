// The server with its real threads and a device of the test's own. Nothing here depends on how fast the machine is.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/haptic_server.h>

#include "allocation_counter.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A simulated glove that takes a step whenever it is read; its states are measured at that moment. Used by the haptic
/// thread alone.
class SteppedDevice final : public devices::GloveDevice {
 public:
  explicit SteppedDevice(const geometry::PoseTrajectory& script, const devices::SimulatedGloveParameters& wearer = {})
      : glove_(script, wearer) {}

  const devices::DeviceDescriptor& descriptor() const noexcept override { return glove_.descriptor(); }
  bool read(devices::GloveState& newest) noexcept override {
    if (!silent_) {
      state_ = glove_.step(kTickPeriod, command_);
      state_.time = clock_.now();
    }
    newest = state_;
    return true;
  }
  void command(const devices::SafeCommand& command) noexcept override {
    const double step = (command.values().f_H_W - command_.values().f_H_W).norm();
    greatest_step_ = std::max(greatest_step_, step);
    command_ = command;
  }

  void fall_silent() { silent_ = true; }
  const devices::SafeCommand& last_command() const { return command_; }
  double greatest_step() const { return greatest_step_; }

 private:
  devices::SimulatedGlove glove_;
  realtime::SteadyClock clock_;
  devices::GloveState state_;
  devices::SafeCommand command_;
  double greatest_step_ = 0.0;
  std::atomic<bool> silent_{false};
};

class Server : public ::testing::Test {
 protected:
  static Isometry3d at_height(double z) { return Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); }

  Server() {
    const Isometry3d X_WH_end = at_height(0.01);
    using std::chrono::milliseconds;
    device_ = std::make_unique<SteppedDevice>(
        geometry::PoseTrajectory({{milliseconds(0), kStart}, {milliseconds(150), X_WH_end}}));
    const Coupling coupling = coupling_for(device_->descriptor(), {1000.0, 2.0});
    sliding_ = std::make_unique<grasping::GraspSimulation>(
        std::vector<contact::Obstacle>{{plate_}},
        std::vector<contact::HeldPart>{{.part_V = box_, .X_WV_start = kStart, .stiffness = coupling.stiffness}});
  }

  static void wait_for(const HapticServer& server) {
    while (!server.is_done())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  static inline const Isometry3d kStart = at_height(0.03);
  std::shared_ptr<const contact::ContactBody> plate_ = std::make_shared<contact::ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 200)));
  std::shared_ptr<const contact::SlidingPart> box_ = std::make_shared<contact::SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 12)));
  std::unique_ptr<SteppedDevice> device_;
  std::unique_ptr<grasping::GraspSimulation> sliding_;
};

TEST_F(Server, PressesThePartOnThePlateAndSendsTheForces) {
  constexpr std::size_t kTicks = 2000;  // the hand presses after 150; a slow simulation has all the rest to follow
  std::vector<devices::HapticState> samples(kTicks);
  std::size_t count = 0;
  std::int64_t allocations = 0;
  HapticServer server({{device_.get()}}, *sliding_, {.ticks = kTicks, .sink = [&](const devices::HapticState& sample) {
                                                       samples[count++] = sample;
                                                       if (count == 1)
                                                         allocations = test_support::allocations_of_this_thread();
                                                       if (count == kTicks)
                                                         allocations =
                                                             test_support::allocations_of_this_thread() - allocations;
                                                     }});
  wait_for(server);
  server.stop();

  EXPECT_EQ(count, kTicks);
  EXPECT_GE(server.statistics().haptic.ticks, kTicks);
  EXPECT_GT(
      std::max_element(samples.begin(), samples.end(),
                       [](const auto& a, const auto& b) { return a.hands[0].force_W.z() < b.hands[0].force_W.z(); })
          ->hands[0]
          .force_W.z(),
      1.0);
  EXPECT_NEAR(samples.back().parts[0].X_WV.translation().z(), 0.02, 20e-6);
  EXPECT_EQ(allocations, 0);  // of the haptic thread, from its first tick to its last
  for (const devices::HapticState& sample : samples)
    EXPECT_GT(sample.parts[0].X_WV.translation().z(), 0.02);
}

/// What every end of a server must leave behind: no force, reached by a ramp.
void expect_faded(const SteppedDevice& device) {
  EXPECT_EQ(device.last_command().values().f_H_W, Vector3d::Zero());
  EXPECT_EQ(device.last_command().values().t_H_W, Vector3d::Zero());
  EXPECT_EQ(device.last_command().values().joint_torques, hands::JointValues{});
  constexpr double kForceStep_N = 20.0 / 7.0;
  EXPECT_LE(device.greatest_step(), 2.0 * kForceStep_N * (1.0 + 1e-9)) << "two periods count at most";
}

TEST_F(Server, ADeviceThatFallsSilentGetsNoForce) {
  std::atomic<bool> is_told{false};
  HapticServer server({{device_.get()}}, *sliding_,
                      {.ticks = 600, .sink = [&](const devices::HapticState& sample) {
                         if (sample.sequence == 400) device_->fall_silent();
                         if (sample.sequence > 500 && sample.hands[0].reasons.is_state_old) is_told = true;
                       }});
  wait_for(server);
  server.stop();
  EXPECT_TRUE(is_told);
  expect_faded(*device_);
}

TEST_F(Server, TheForceFadesAtTheEnd) {
  HapticServer server({{device_.get()}}, *sliding_, {.ticks = 1000});
  wait_for(server);
  expect_faded(*device_);
  EXPECT_EQ(server.ticks(), 1000);
}

/// A hand that closes its fingers on the plate, 50 mm below it.
TEST_F(Server, TheTorquesOfFingersFadeAtTheEndToo) {
  devices::SimulatedGloveParameters wearer;
  wearer.open_posture.emplace().fill(0.0);
  wearer.grasp_posture.fill(0.0);
  for (const std::size_t flexion : {4U, 5U, 7U, 8U, 11U, 12U, 15U, 16U})  // hands::kJointNames
    wearer.grasp_posture[flexion] = 1.2;
  wearer.starts_closed = false;
  wearer.grip_changes = {std::chrono::milliseconds(100)};
  SteppedDevice glove(geometry::PoseTrajectory({{std::chrono::nanoseconds(0), at_height(0.05)}}), wearer);
  grasping::GraspSimulation simulation({{plate_}}, {{.part_V = box_, .X_WV_start = at_height(0.3)}},
                                       {std::make_shared<const grasping::HandModel>(grasping::make_hand())});
  std::atomic<bool> presses{false};
  HapticServer server({{&glove}}, simulation, {.sink = [&](const devices::HapticState& sample) {
                        for (const double torque : sample.hands[0].joint_torques)
                          if (std::abs(torque) > 0.4) presses = true;
                      }});
  while (!presses)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.stop();
  expect_faded(glove);
}

TEST_F(Server, TheForceFadesWhenItIsStopped) {
  std::atomic<bool> pushes{false};
  HapticServer server({{device_.get()}}, *sliding_, {.sink = [&](const devices::HapticState& sample) {
                        if (sample.hands[0].force_W.norm() > 0.5) pushes = true;
                      }});
  while (!pushes)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.stop();
  expect_faded(*device_);
}

TEST_F(Server, EmergencyStopRemovesTheForceAndIsReported) {
  std::atomic<bool> pushes{false};
  std::atomic<bool> is_told{false};
  HapticServer server({{device_.get()}}, *sliding_, {.sink = [&](const devices::HapticState& sample) {
                        if (sample.hands[0].force_W.norm() > 0.5) pushes = true;
                        if (sample.hands[0].reasons.is_stopped && sample.hands[0].force_W.isZero(0.0)) is_told = true;
                      }});
  while (!pushes)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.emergency_stop();
  while (!is_told)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.stop();
  expect_faded(*device_);
}

TEST_F(Server, FailingSinkRemovesTheForceAndIsReported) {
  HapticServer server({{device_.get()}}, *sliding_, {.ticks = 2000, .sink = [](const devices::HapticState& sample) {
                                                       if (sample.hands[0].force_W.norm() > 0.5)
                                                         throw std::runtime_error("the disk is full");
                                                     }});
  wait_for(server);
  server.stop();
  EXPECT_TRUE(server.has_failed());
  EXPECT_EQ(server.failure(), "the disk is full");
  expect_faded(*device_);
}

TEST_F(Server, GraspAndReleaseCallsTakeEffect) {
  std::atomic<std::int32_t> part{-2};
  HapticServer server({{device_.get()}}, *sliding_,
                      {.sink = [&](const devices::HapticState& sample) { part = sample.hands[0].part; }});
  const auto wait_until_it_holds = [&](std::int32_t number) {
    while (part != number)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  wait_until_it_holds(0);
  EXPECT_TRUE(server.release(0));
  wait_until_it_holds(-1);
  EXPECT_TRUE(server.grasp(0, 0));
  wait_until_it_holds(0);
  EXPECT_FALSE(server.grasp(0, 1)) << "there is no such part";
  EXPECT_FALSE(server.grasp(1, 0)) << "nor such a hand";
  EXPECT_FALSE(server.release(1));
}

/// A clock that wakes each thread 3 ms too late every twentieth time.
class LateClock final : public realtime::Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override { return clock_.now(); }
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override {
    thread_local int sleeps = 0;
    const bool is_late = ++sleeps % 20 == 0;
    clock_.sleep_until(is_late ? deadline + std::chrono::milliseconds(3) : deadline);
  }

 private:
  realtime::SteadyClock clock_;
};

TEST_F(Server, CountsLateTicksWhileItRuns) {
  LateClock clock;
  HapticServer server({{device_.get()}}, *sliding_, {.clock = &clock});
  while (server.ticks() < 100)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GE(server.late_ticks(), 4);
  server.stop();
  EXPECT_EQ(server.late_ticks(), static_cast<std::int64_t>(server.statistics().haptic.late_ticks));
}

TEST_F(Server, CountsPageFaultsOfTheHapticThread) {
  constexpr std::size_t kPages = 200;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, kPages * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  HapticServer server({{device_.get()}}, *sliding_, {.ticks = 20, .sink = [&](const devices::HapticState& sample) {
                                                       if (sample.sequence != 10) return;
                                                       for (std::size_t i = 0; i < kPages; ++i)
                                                         static_cast<volatile char*>(memory)[i * page] = 1;
                                                     }});
  wait_for(server);
  server.stop();
  EXPECT_GE(server.statistics().page_faults, static_cast<std::int64_t>(kPages) / 16) << "or pages of up to 64 KiB";
  munmap(memory, kPages * page);
}

TEST_F(Server, RefusesToSpinForMoreThanHalfOfThePeriod) {
  EXPECT_THROW(HapticServer({{device_.get()}}, *sliding_, {.spin = std::chrono::microseconds(501)}),
               std::invalid_argument);
}

TEST_F(Server, RunsForATimeOrUntilItIsDone) {
  HapticServer(std::vector<HandInLoop<devices::GloveDevice>>{{device_.get()}}, *sliding_, {.ticks = 20}).wait();
  expect_faded(*device_);
  HapticServer server({{device_.get()}}, *sliding_);
  server.run_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(server.is_done());
  EXPECT_GT(server.ticks(), 0);
  expect_faded(*device_);
  EXPECT_THROW(HapticServer({{device_.get()}}, *sliding_).wait(), std::invalid_argument) << "it has no end";
  const auto fails = [](const devices::HapticState&) { throw std::runtime_error("the disk is full"); };
  EXPECT_THROW(HapticServer({{device_.get()}}, *sliding_, {.sink = fails}).run_for(std::chrono::hours(1)),
               std::runtime_error);
}

TEST_F(Server, StopsWhenItIsToldTo) {
  HapticServer server({{device_.get()}}, *sliding_);
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

// The server with its real threads and a device of the test's own. Nothing here depends on how fast the machine is.

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <glissade/contact/sliding.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/haptics/offline_run.h>

#include "allocation_counter.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A simulated glove that takes a step whenever it is read; its states are measured at that moment. Used by the haptic
/// thread alone.
class SteppedDevice final : public devices::GloveDevice {
 public:
  explicit SteppedDevice(const geometry::PoseTrajectory& script) : glove_(script) {}

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
  Server() {
    const Isometry3d X_WH_end(Eigen::Translation3d(0.0, 0.0, 0.01));
    using std::chrono::milliseconds;
    device_ = std::make_unique<SteppedDevice>(
        geometry::PoseTrajectory({{milliseconds(0), kStart}, {milliseconds(150), X_WH_end}}));
    const Coupling coupling = coupling_for(device_->descriptor(), {1000.0, 2.0});
    sliding_ = std::make_unique<contact::MultiPartSliding>(
        std::vector<contact::Obstacle>{{plate_}},
        std::vector<contact::HeldPart>{{.part_V = box_, .X_WV_start = kStart, .stiffness = coupling.stiffness}});
  }

  static void wait_for(const HapticServer& server) {
    while (!server.is_done())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  static inline const Isometry3d kStart{Eigen::Translation3d(0.0, 0.0, 0.03)};
  std::shared_ptr<const contact::ContactBody> plate_ = std::make_shared<contact::ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_plate({0.5, 0.5}, 200)));
  std::shared_ptr<const contact::SlidingPart> box_ = std::make_shared<contact::SlidingPart>(
      std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.06, 0.04}, 12)));
  std::unique_ptr<SteppedDevice> device_;
  std::unique_ptr<contact::MultiPartSliding> sliding_;
  realtime::SteadyClock clock_;
};

TEST_F(Server, PressesThePartOnThePlateAndSendsTheForces) {
  constexpr std::size_t kTicks = 2000;  // the hand presses after 150; a slow simulation has all the rest to follow
  std::vector<devices::HapticState> samples(kTicks);
  std::size_t count = 0;
  std::int64_t allocations = 0;
  HapticServer server({{device_.get()}}, *sliding_, clock_,
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
  EXPECT_EQ(device.last_command().values().joint_torques, devices::JointValues{});
  constexpr double kForceStep_N = 20.0 / 7.0;
  EXPECT_LE(device.greatest_step(), 2.0 * kForceStep_N * (1.0 + 1e-9)) << "two periods count at most";
}

TEST_F(Server, ADeviceThatFallsSilentGetsNoForce) {
  std::atomic<bool> is_told{false};
  HapticServer server({{device_.get()}}, *sliding_, clock_,
                      [&](const devices::HapticState& sample) {
                        if (sample.sequence == 400) device_->fall_silent();
                        if (sample.sequence > 500 && sample.hands[0].reasons.is_state_old) is_told = true;
                      },
                      {.ticks = 600});
  wait_for(server);
  server.stop();
  EXPECT_TRUE(is_told);
  expect_faded(*device_);
}

TEST_F(Server, TheForceFadesAtTheEnd) {
  HapticServer server({{device_.get()}}, *sliding_, clock_, [](const devices::HapticState&) {}, {.ticks = 1000});
  wait_for(server);
  expect_faded(*device_);
  EXPECT_EQ(server.ticks(), 1000);
}

/// Parts, and a hand whose first joint something stops, far before the angle of the glove.
class StoppedFinger final : public LoopSimulation {
 public:
  explicit StoppedFinger(contact::MultiPartSliding& parts) : parts_(parts) {}
  const contact::MultiPartSliding& parts() const override { return parts_.parts(); }
  void take_part(std::size_t part, const Isometry3d& X_WG) override { parts_.take_part(part, X_WG); }
  void leave_part(std::size_t part) override { parts_.leave_part(part); }
  void advance(const Ghosts& ghosts, double milliseconds) override { parts_.advance(ghosts, milliseconds); }
  void tell_hands(ContactSet& set) const override {
    HandAnswer& hand = set.hands[0];
    hand.visible.activity = devices::HandActivity::kFree;
    hand.visible.angles[0] = -0.6;
    hand.row_count = 1;
    hand.row_array[0].rates[0] = -0.03;
  }

 private:
  PartsInLoop parts_;
};

TEST_F(Server, TheTorquesOfFingersFadeAtTheEndToo) {
  StoppedFinger simulation(*sliding_);
  FingerHand fingers;
  fingers.limits.lower.fill(-1.0);
  fingers.limits.upper.fill(1.0);
  double greatest_Nm = 0.0;
  HapticServer server({{.device = device_.get(), .part = std::nullopt, .fingers = fingers}}, simulation, clock_,
                      [&](const devices::HapticState& sample) {
                        greatest_Nm = std::max(greatest_Nm, -sample.hands[0].joint_torques[0]);
                      },
                      {.ticks = 1000});
  wait_for(server);
  EXPECT_GT(greatest_Nm, 0.4);
  expect_faded(*device_);
}

TEST_F(Server, TheForceFadesWhenItIsStopped) {
  std::atomic<bool> pushes{false};
  HapticServer server({{device_.get()}}, *sliding_, clock_, [&](const devices::HapticState& sample) {
    if (sample.hands[0].force_W.norm() > 0.5) pushes = true;
  });
  while (!pushes)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.stop();
  expect_faded(*device_);
}

TEST_F(Server, AnEmergencyStopTakesTheForceAwayAndIsTold) {
  std::atomic<bool> pushes{false};
  std::atomic<bool> is_told{false};
  HapticServer server({{device_.get()}}, *sliding_, clock_, [&](const devices::HapticState& sample) {
    if (sample.hands[0].force_W.norm() > 0.5) pushes = true;
    if (sample.hands[0].reasons.is_stopped && sample.hands[0].force_W.isZero(0.0)) is_told = true;
  });
  while (!pushes)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.emergency_stop();
  while (!is_told)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.stop();
  expect_faded(*device_);
}

TEST_F(Server, ASinkThatFailsTakesTheForceAwayAndIsTold) {
  HapticServer server({{device_.get()}}, *sliding_, clock_,
                      [](const devices::HapticState& sample) {
                        if (sample.hands[0].force_W.norm() > 0.5) throw std::runtime_error("the disk is full");
                      },
                      {.ticks = 2000});
  wait_for(server);
  server.stop();
  EXPECT_TRUE(server.has_failed());
  EXPECT_EQ(server.failure(), "the disk is full");
  expect_faded(*device_);
}

TEST_F(Server, LetsGoAndTakesHoldWhenItIsTold) {
  std::atomic<std::int32_t> part{-2};
  HapticServer server({{device_.get()}}, *sliding_, clock_,
                      [&](const devices::HapticState& sample) { part = sample.hands[0].part; });
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
  HapticServer server({{device_.get()}}, *sliding_, clock, [](const devices::HapticState&) {});
  while (server.ticks() < 100)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GE(server.late_ticks(), 4);
  server.stop();
  EXPECT_EQ(server.late_ticks(), static_cast<std::int64_t>(server.statistics().haptic.late_ticks));
}

TEST_F(Server, CountsThePagesThatTheHapticThreadWaitsFor) {
  constexpr std::size_t kPages = 200;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, kPages * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  HapticServer server({{device_.get()}}, *sliding_, clock_,
                      [&](const devices::HapticState& sample) {
                        if (sample.sequence != 10) return;
                        for (std::size_t i = 0; i < kPages; ++i)
                          static_cast<volatile char*>(memory)[i * page] = 1;
                      },
                      {.ticks = 20});
  wait_for(server);
  server.stop();
  EXPECT_GE(server.statistics().page_faults, static_cast<std::int64_t>(kPages) / 16) << "or pages of up to 64 KiB";
  munmap(memory, kPages * page);
}

TEST_F(Server, RefusesToSpinForMoreThanHalfOfThePeriod) {
  const HapticServerOptions options{.spin = std::chrono::microseconds(501)};
  EXPECT_THROW(HapticServer(
                   {{device_.get()}}, *sliding_, clock_, [](const devices::HapticState&) {}, options),
               std::invalid_argument);
}

TEST_F(Server, RefusesAnEmptySink) {
  EXPECT_THROW(HapticServer({{device_.get()}}, *sliding_, clock_, {}), std::invalid_argument);
}

TEST_F(Server, StopsWhenItIsToldTo) {
  HapticServer server({{device_.get()}}, *sliding_, clock_, [](const devices::HapticState&) {});
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

/// From a server to servos and back: link, bridge, wire, emulated hand. In real time, with three threads.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include <glissade/bridges/bridge.h>
#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/devices/lcm_glove.h>

#include "dynamixel/emulated_glove.h"
#include "emulation/emulated_line.h"

namespace glissade::bridges {
namespace {

constexpr std::size_t kIndexPip = 5;

DynamixelHand one_servo() {
  DynamixelHand hand;
  hand.servos = {{.id = 1, .joint = kIndexPip, .zero = 3.0}};
  return hand;
}

/// Commands a limit until an angle satisfies `is_reached`, for at most 20 s.
template <class Condition>
bool is_reached_under(const devices::JointLimit& limit, devices::LcmGlove& glove, Condition is_reached) {
  devices::SafetyEnvelope envelope(glove.descriptor(), 100.0);
  const realtime::SteadyClock clock;
  devices::GloveState state;
  static std::int64_t sequence = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!glove.read(state)) continue;
    if (is_reached(state.joint_angles[kIndexPip])) return true;
    devices::GloveCommand command;
    command.sequence = ++sequence;
    command.state_sequence = state.sequence;
    command.state_time = state.time;
    command.joint_limits.joints[kIndexPip] = limit;
    glove.command(envelope.limit(command, state, clock.now()));
  }
  return false;
}

/// Tells, each time that the finger is open again, whether it has closed to an angle from `least` to `most` (rad).
class ClosesTo {
 public:
  ClosesTo(double least, double most) : least_(least), most_(most) {}

  bool operator()(double angle) {
    constexpr double kOpen_rad = 0.35;
    if (angle < kOpen_rad) {
      const double farthest = std::exchange(farthest_, 0.0);
      return farthest >= least_ && farthest <= most_;
    }
    farthest_ = std::max(farthest_, angle);
    return false;
  }

 private:
  double least_;
  double most_;
  double farthest_ = 0.0;
};

/// The wearer closes the finger to 80° (1.4 rad), and opens it, each two seconds. The inertia and friction of gears
/// let the finger go some tenths of a rad too far or not far enough.
hands::JointValues beckon(std::chrono::nanoseconds time) {
  const double time_s = std::chrono::duration<double>(time).count();
  return angles_of({0.0, 0.4 * (1.0 - std::cos(std::numbers::pi * time_s)), 0.0, 0.0, 0.0});
}

TEST(BridgeToServos, LimitOfTheServerHoldsTheFinger) {
  const auto glove_of_one = dynamixel::emulate(one_servo(), dynamixel::model_of(one_servo()), beckon);
  const auto clock = std::make_shared<realtime::SteadyClock>();
  const auto wire = make_dynamixel_wire(one_servo(), std::make_shared<EmulatedLine>(glove_of_one.bus, clock));
  const auto bus = std::make_shared<devices::LcmBus>("memq://");
  devices::LcmGlove glove(bus, wire->descriptor());
  std::atomic<bool> goes_on{true};
  BridgeStatistics statistics;
  std::thread bridge([&] {
    BridgeOptions options;
    options.link.patience_periods = 100.0;  // a test may run on a busy machine
    statistics = run_bridge(
        *wire, bus, options, [&] { return goes_on.load(); }, [](const std::string&) {});
  });
  EXPECT_TRUE(is_reached_under({}, glove, ClosesTo(1.1, 1.8))) << "the finger is free";
  const devices::JointLimit limit{.upper = 0.5, .stiffness = 5.0, .max_torque = 0.15};
  EXPECT_TRUE(is_reached_under(limit, glove, ClosesTo(0.5, 1.0))) << "the finger is held";
  EXPECT_TRUE(is_reached_under({}, glove, ClosesTo(1.1, 1.8))) << "the finger is free again";
  goes_on = false;
  bridge.join();
  EXPECT_GT(statistics.states, 0U);
}

}  // namespace
}  // namespace glissade::bridges

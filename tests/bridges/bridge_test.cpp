/// The loop between a wire and the link: what it says, and that it releases.

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/bridge.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/clock.h>

namespace glissade::bridges {
namespace {

using testing::ElementsAre;

constexpr std::size_t kFinger = 4;

/// A wire that fails in the turns of a list.
class FailingWire final : public Wire {
 public:
  explicit FailingWire(std::vector<int> failures) : failures_(std::move(failures)) {
    descriptor_.name = "test";
    descriptor_.finger_command = devices::FingerCommand::kJointLimit;
    descriptor_.max_joint_torque = 0.5;
    descriptor_.max_limit_stiffness = 2.0;
    descriptor_.joint_upper[kFinger] = 1.5;
  }

  const devices::DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  void open() override { fail_if_due(); }
  bool read(devices::GloveState& state) override {
    fail_if_due();
    X_WH = state.X_WH;
    state.time = clock.now();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return true;
  }
  void write(const devices::SafeCommand& command) override {
    limits.push_back(command.values().joint_limits.joints[kFinger].max_torque);
    turns.push_back(turn);
  }
  void release() noexcept override { ++releases; }

  realtime::SteadyClock clock;
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  std::vector<double> limits;  ///< torques of the limit of a finger, in each command
  std::vector<int> turns;      ///< at which these commands came
  int releases = 0;
  int turn = 0;

  int failed_at = 0;
  int last_turn = 1'000'000;

  void fail_at(int turn_to_fail) {
    failures_.push_back(turn_to_fail);
    failed_at = turn_to_fail;
    last_turn = turn_to_fail + 5;
  }

 private:
  void fail_if_due() {
    ++turn;
    for (const int failure : failures_)
      if (failure == turn) throw WireError("turn " + std::to_string(turn));
  }

  std::vector<int> failures_;
  devices::DeviceDescriptor descriptor_;
};

/// What the bridge says until this turn of the wire.
std::vector<std::string> said(FailingWire& wire, int last_turn) {
  std::vector<std::string> sentences;
  run_bridge(
      wire, std::make_shared<devices::LcmBus>("memq://"), {.reopen_after = std::chrono::milliseconds(1)},
      [&] { return wire.turn < last_turn; }, [&](const std::string& sentence) { sentences.push_back(sentence); });
  return sentences;
}

TEST(Bridge, ReleasesAtItsEnd) {
  FailingWire wire({});
  EXPECT_THAT(said(wire, 5), ElementsAre("the device is connected"));
  EXPECT_EQ(wire.releases, 1);
}

TEST(Bridge, SaysOnceWhatIsWrongAndWhenTheDeviceIsBack) {
  FailingWire wire({1, 2, 3, 6, 7});
  EXPECT_THAT(said(wire, 20), ElementsAre("turn 1", "the device is connected", "turn 6", "the device is back"));
  EXPECT_EQ(wire.releases, 6) << "after each failure, and at the end";
}

TEST(Bridge, HandStaysWhereItIsToBe) {
  FailingWire wire({});
  const Eigen::Isometry3d X_WH(Eigen::Translation3d(0.1, 0.2, 0.3));
  run_bridge(
      wire, std::make_shared<devices::LcmBus>("memq://"), {.X_WH = X_WH}, [&] { return wire.turn < 3; },
      [](const std::string&) {});
  EXPECT_EQ(wire.X_WH.translation().z(), 0.3);
}

/// A server that answers each state with a limit of the finger.
void answer(devices::LcmGlove& glove, devices::SafetyEnvelope& envelope, const realtime::SteadyClock& clock) {
  devices::GloveState state;
  if (!glove.read(state)) return;
  devices::GloveCommand command;
  command.sequence = command.state_sequence = state.sequence;
  command.state_time = state.time;
  command.joint_limits.joints[kFinger] = {.upper = 0.5, .stiffness = 2.0, .max_torque = 0.5};
  glove.command(envelope.limit(command, state, clock.now()));
}

// The limit that was there before a failure must not act on a device that has just come back.
TEST(Bridge, DeviceThatIsBackIsFreeAtFirst) {
  FailingWire wire({});
  const auto bus = std::make_shared<devices::LcmBus>("memq://");
  devices::LcmGlove glove(bus, wire.descriptor());
  devices::SafetyEnvelope envelope(wire.descriptor(), 100.0);
  bool has_failed = false;
  const auto end = wire.clock.now() + std::chrono::seconds(20);
  BridgeOptions options{.reopen_after = std::chrono::milliseconds(200)};
  options.link.patience_periods = 50.0;  // a test may run on a busy machine
  run_bridge(
      wire, bus, options,
      [&] {
        if (!has_failed) answer(glove, envelope, wire.clock);
        const bool is_held = !wire.limits.empty() && wire.limits.back() > 0.4;
        if (is_held && !std::exchange(has_failed, true)) wire.fail_at(wire.turn + 1);
        return wire.turn < wire.last_turn && wire.clock.now() < end;
      },
      [](const std::string&) {});
  ASSERT_TRUE(has_failed) << "the limit never came";
  const auto back = std::find_if(wire.turns.begin(), wire.turns.end(), [&](int t) { return t > wire.failed_at; });
  ASSERT_NE(back, wire.turns.end());
  EXPECT_EQ(wire.limits[static_cast<std::size_t>(back - wire.turns.begin())], 0.0);
}

}  // namespace
}  // namespace glissade::bridges

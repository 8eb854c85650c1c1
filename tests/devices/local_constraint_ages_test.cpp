/// The table "Ages" of docs/safety.md for half-spaces and limits that the device holds by itself: nothing tightens on
/// old data, and nothing stays.

#include <cmath>

#include <gtest/gtest.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

constexpr std::size_t kBentJoint = 4;

/// An arm that holds half-spaces, with a glove that holds limits.
DeviceDescriptor holding_device() {
  DeviceDescriptor device = simulated_glove_descriptor();  // 1000 Hz
  device.tool_command = ToolCommand::kHalfSpaces;
  device.finger_command = FingerCommand::kJointLimit;
  device.max_limit_stiffness = 2.0;
  return device;
}

/// A hand 5 mm below a floor, with a finger 0.1 rad beyond a limit, at one end of a link.
class EndOfLink {
 public:
  explicit EndOfLink(double patience_periods) : envelope_(holding_device(), patience_periods) {
    state_.X_WH.translation().z() = -5e-3;
    state_.joint_angles[kBentJoint] = 0.6;
    for (int i = 0; i < 300; ++i)
      tick(true, true);
  }

  /// A millisecond later, with or without a new state, and a command that answers it or the last answered one.
  void tick(bool has_new_state, bool has_new_command) {
    now_ += milliseconds(1);
    if (has_new_state) {
      ++state_.sequence;
      state_.time = now_;
    }
    if (has_new_command) command_.state_time = state_.time;
    safe_ = envelope_.limit(command_, state_, now_);
  }

  /// Wants a floor 1 mm higher, and a limit 0.05 rad tighter.
  void tighten() {
    floor_ += 1e-3;
    limit_ -= 0.05;
    command_ = wanted(command_.state_time);
  }

  double force() const { return half_space_wrench(safe_.values().half_spaces, state_.X_WH).f_H_W.z(); }
  double torque() const {
    return -limit_torque(safe_.values().joint_limits.joints[kBentJoint], state_.joint_angles[kBentJoint], 0.0);
  }
  bool is_at_rest() const { return safe_.values().is_at_rest(); }

 private:
  GloveCommand wanted(std::chrono::nanoseconds state_time) const {
    GloveCommand command;
    command.state_time = state_time;
    HalfSpaces& half_spaces = command.half_spaces;
    half_spaces.count = 1;
    half_spaces.rows[0] = {Vector3d::UnitZ(), Vector3d::Zero(), floor_};
    half_spaces.stiffness = 1000.0;
    half_spaces.rotational_stiffness = 5.0;
    half_spaces.max_force = 20.0;
    half_spaces.max_torque = 1.0;
    command.joint_limits.joints[kBentJoint] = {.upper = limit_, .stiffness = 2.0, .max_torque = 0.5};
    return command;
  }

  double floor_ = 0.0;
  double limit_ = 0.5;
  SafetyEnvelope envelope_;
  GloveState state_;
  GloveCommand command_ = wanted({});
  SafeCommand safe_;
  std::chrono::nanoseconds now_{milliseconds(100)};
};

/// From the first tick after `patience` periods on, nothing tightens; after seven more, nothing is left.
void expect_fade(EndOfLink& end, int patience, bool has_new_state, bool has_new_command) {
  EXPECT_NEAR(end.force(), 5.0, 1e-9);
  EXPECT_NEAR(end.torque(), 0.2, 1e-9);
  for (int i = 0; i < patience; ++i)
    end.tick(has_new_state, has_new_command);
  EXPECT_NEAR(end.force(), 5.0, 1e-9) << "not old yet";
  for (int i = 0; i < 8; ++i) {
    const double force = end.force();
    const double torque = end.torque();
    end.tighten();
    end.tick(has_new_state, has_new_command);
    EXPECT_LE(end.force(), force) << i;
    EXPECT_LE(end.torque(), torque) << i;
  }
  EXPECT_TRUE(end.is_at_rest());
  for (int i = 0; i < 100; ++i) {
    end.tighten();
    end.tick(has_new_state, has_new_command);
    ASSERT_TRUE(end.is_at_rest()) << i;
  }
}

TEST(LocalConstraintsOfOldData, FadeAtTheServerOnceTheStateIsThreePeriodsOld) {
  EndOfLink server(3.0);
  expect_fade(server, 3, false, false);
}

TEST(LocalConstraintsOfOldData, FadeAtTheGloveOnceTheCommandAnswersAStateOfSixPeriods) {
  EndOfLink glove(6.0);
  expect_fade(glove, 6, true, false);
}

}  // namespace
}  // namespace glissade::devices

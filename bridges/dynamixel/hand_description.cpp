#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/devices/glove_model.h>

#include "dynamixel/joint_scale.h"
#include "dynamixel/measuring_board.h"
#include "dynamixel/packet.h"

namespace glissade::bridges {
namespace {

using dynamixel::JointScale;
using dynamixel::ServoModel;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kWatchdogStep_s = 0.02;

/// Throws, naming the hand, unless `holds`.
void require_of_hand(const DynamixelHand& hand, bool holds, const std::string& rule) {
  if (!holds) throw std::invalid_argument("Hand '" + hand.name + "': " + rule + ".");
}

bool is_within(double value, double least, double most) {
  return value >= least && value <= most;  // false for NaN
}

std::size_t index_of(int joint) {
  return static_cast<std::size_t>(joint);
}

void check_servo(const DynamixelHand& hand, const DynamixelServo& servo) {
  const std::string who = "servo " + std::to_string(servo.id) + ": ";
  require_of_hand(hand, servo.id >= 0 && servo.id <= dynamixel::kLastId, who + "the id must be from 0 to 252");
  require_of_hand(hand, servo.joint >= 0 && servo.joint < hands::kJoints, who + "there is no such joint");
  require_of_hand(hand, is_within(std::abs(servo.ratio), 0.01, 100.0),
                  who + "ratio must be from 0.01 to 100, or negative");
  require_of_hand(hand, is_within(servo.zero, -1000.0, 1000.0), who + "zero must be an angle in rad");
  require_of_hand(hand, is_within(servo.torque_per_current, 0.0, 100.0),
                  who + "torque_per_current must be from 0 to 100 Nm/A");
  require_of_hand(hand, is_within(servo.max_current, 0.001, 10.0), who + "max_current must be from 0.001 to 10 A");
}

void check_measured(const DynamixelHand& hand, const MeasuredJoint& measured) {
  const std::string who = "channel " + std::to_string(measured.channel) + ": ";
  require_of_hand(hand, measured.channel >= 0 && measured.channel < static_cast<int>(dynamixel::kBoardChannels),
                  who + "the channel must be from 0 to 15");
  require_of_hand(hand, measured.joint >= 0 && measured.joint < hands::kJoints, who + "there is no such joint");
  require_of_hand(hand, is_within(std::abs(measured.ratio), 0.01, 100.0),
                  who + "ratio must be from 0.01 to 100, or negative");
  require_of_hand(hand, is_within(measured.zero, -1000.0, 1000.0), who + "zero must be an angle in rad");
}

void check_uses(const DynamixelHand& hand) {
  std::array<int, 256> uses_of_id{};
  std::array<int, hands::kJoints> uses_of_joint{};
  for (const DynamixelServo& servo : hand.servos) {
    require_of_hand(hand, ++uses_of_id[static_cast<std::size_t>(servo.id)] == 1,
                    "two servos have the id " + std::to_string(servo.id));
    ++uses_of_joint[index_of(servo.joint)];
  }
  for (const MeasuredJoint& measured : hand.measured)
    ++uses_of_joint[index_of(measured.joint)];
  for (std::size_t joint = 0; joint < uses_of_joint.size(); ++joint) {
    require_of_hand(hand, uses_of_joint[joint] <= 1,
                    std::string(hands::kJointNames[joint]) + " is measured by two servos or channels");
  }
}

}  // namespace

void validate(const DynamixelHand& hand) {
  require_of_hand(hand, dynamixel::find_model(hand.model).has_value(),
                  "there is no model " + hand.model + "; the models are " + dynamixel::model_names());
  require_of_hand(hand, !hand.servos.empty(), "a hand needs a servo");
  for (const DynamixelServo& servo : hand.servos)
    check_servo(hand, servo);
  for (const MeasuredJoint& measured : hand.measured)
    check_measured(hand, measured);
  check_uses(hand);
  const auto seconds = [](std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); };
  require_of_hand(hand, is_within(hand.baud_rate, 9600.0, 4.5e6), "baud_rate must be from 9600 to 4500000");
  require_of_hand(hand, is_within(seconds(hand.period), 0.0005, 0.1), "period must be from 0.5 to 100 ms");
  require_of_hand(hand, is_within(seconds(hand.patience), 0.0001, 0.1), "patience must be from 0.1 to 100 ms");
  require_of_hand(hand, is_within(seconds(hand.watchdog), kWatchdogStep_s, 127 * kWatchdogStep_s),
                  "watchdog must be from 20 ms to 2.54 s");
  require_of_hand(hand, hand.watchdog >= 3 * hand.period, "watchdog must be at least three periods");
  require_of_hand(hand, is_within(hand.position_d_gain, 0.0, 16383.0), "position_d_gain must be from 0 to 16383");
  require_of_hand(hand, is_within(hand.current_per_gain, 1e-9, 1.0), "current_per_gain must be from 1e-9 to 1 A");
  require_of_hand(hand, is_within(hand.max_stiffness, 0.001, 1000.0),
                  "max_stiffness must be from 0.001 to 1000 Nm/rad");
}

devices::DeviceDescriptor descriptor_of(const DynamixelHand& hand) {
  validate(hand);
  const ServoModel model = *dynamixel::find_model(hand.model);
  devices::DeviceDescriptor device;
  device.name = hand.name;
  // No force on the hand: a server couples parts to it as for the preset.
  const devices::DeviceDescriptor preset = devices::descriptor_of(devices::read_glove_model("dynamixel"));
  device.max_stiffness = preset.max_stiffness;
  device.max_rotational_stiffness = preset.max_rotational_stiffness;
  device.finger_command = devices::FingerCommand::kJointLimit;
  // The bus may be faster. But states and commands are old after a few of these periods, on a busy computer after 15
  // ms, and the servos hold limits without them.
  constexpr double kAnnounced_Hz = 200.0;
  device.update_rate = std::min(1e9 / static_cast<double>(hand.period.count()), kAnnounced_Hz);
  device.delay = std::chrono::milliseconds(1);  // of the bus
  // The loop in the servo is not documented. Its clock ticks once a millisecond.
  device.limit_rate = 1000.0;
  device.limit_delay = std::chrono::milliseconds(1);
  device.max_joint_torque = std::numeric_limits<double>::infinity();
  device.max_limit_stiffness = hand.max_stiffness;
  device.undriven_joints.set();
  const auto announce = [&device](int joint) {
    device.joint_lower[index_of(joint)] = hands::kJointRanges[index_of(joint)].lower_deg * kDegree;
    device.joint_upper[index_of(joint)] = hands::kJointRanges[index_of(joint)].upper_deg * kDegree;
  };
  for (const DynamixelServo& servo : hand.servos) {
    const JointScale scale(hand, servo, model);
    announce(servo.joint);
    device.undriven_joints.reset(index_of(servo.joint));
    // One number for all joints: what each of them can give.
    device.max_joint_torque = std::min(device.max_joint_torque, scale.max_torque());
    device.max_limit_stiffness = std::min(device.max_limit_stiffness, scale.max_stiffness());
    device.joint_resolution = std::max(device.joint_resolution, scale.resolution());
  }
  for (const MeasuredJoint& measured : hand.measured)
    announce(measured.joint);
  return device;
}

}  // namespace glissade::bridges

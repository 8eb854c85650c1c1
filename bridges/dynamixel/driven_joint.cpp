#include "dynamixel/driven_joint.h"

#include <string_view>

namespace glissade::bridges::dynamixel {
namespace {

std::int64_t field_of(std::string_view registers, const Register& first, const Register& wanted) {
  return decode_register(wanted, registers.substr(wanted.address - first.address, wanted.size));
}

void send_gains(ServoBus& bus, std::vector<DrivenJoint>& joints) {
  std::vector<SyncWriteEntry> entries;
  for (DrivenJoint& joint : joints) {
    if (!joint.goal.has_torque) continue;
    const std::int64_t gain = joint.scale.p_gain(joint.goal.stiffness);
    if (joint.gain == gain) continue;
    joint.gain = gain;
    entries.push_back({joint.id, encode_register(kPositionPGain, gain)});
  }
  bus.sync_write(kPositionPGain.address, entries);
}

void send_caps_and_positions(ServoBus& bus, const std::vector<DrivenJoint>& joints) {
  std::vector<SyncWriteEntry> currents;
  std::vector<SyncWriteEntry> positions;
  for (const DrivenJoint& joint : joints) {
    if (!joint.goal.has_torque) continue;
    currents.push_back({joint.id, encode_register(kGoalCurrent, joint.scale.current(joint.goal.max_torque))});
    positions.push_back({joint.id, encode_register(kGoalPosition, joint.scale.position(joint.goal.angle))});
  }
  bus.sync_write(kGoalCurrent.address, currents);
  bus.sync_write(kGoalPosition.address, positions);
}

}  // namespace

DrivenJoint::DrivenJoint(const DynamixelHand& hand, const DynamixelServo& servo, const ServoModel& model)
    : id(static_cast<std::uint8_t>(servo.id)),
      joint(static_cast<std::size_t>(servo.joint)),
      scale(hand, servo, model),
      holder(scale.play()) {}

void DrivenJoint::take_measurement(const std::string& registers) {
  angle = scale.angle(field_of(registers, kFirstMeasured, kPresentPosition));
  rate = scale.rate(field_of(registers, kFirstMeasured, kPresentVelocity));
}

void DrivenJoint::forget() noexcept {
  holder.reset();
  goal = {};
  has_torque = false;
  gain.reset();
}

void send_goals(ServoBus& bus, std::vector<DrivenJoint>& joints) {
  std::vector<SyncWriteEntry> off;
  std::vector<SyncWriteEntry> on;
  for (DrivenJoint& joint : joints) {
    if (!joint.goal.has_torque) off.push_back({joint.id, encode_register(kTorqueEnable, 0)});
    if (joint.goal.has_torque && !joint.has_torque) on.push_back({joint.id, encode_register(kTorqueEnable, 1)});
    joint.has_torque = joint.goal.has_torque;
  }
  bus.sync_write(kTorqueEnable.address, off);
  send_gains(bus, joints);
  send_caps_and_positions(bus, joints);
  if (on.empty()) return;
  bus.sync_write(kTorqueEnable.address, on);
  send_caps_and_positions(bus, joints);
}

std::string torque_off(std::span<const std::uint8_t> ids) {
  std::vector<SyncWriteEntry> off;
  for (const std::uint8_t id : ids)
    off.push_back({id, encode_register(kTorqueEnable, 0)});
  return encode(sync_write_instruction(kTorqueEnable.address, off));
}

}  // namespace glissade::bridges::dynamixel

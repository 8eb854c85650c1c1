#include <algorithm>
#include <numbers>
#include <stdexcept>

#include <glissade/devices/glove_model.h>

#include "glove_model/delay_line.h"
#include "glove_model/finger_table.h"
#include "glove_model/model_numbers.h"

namespace glissade::devices {
namespace {

constexpr double kStiffnessWithoutForce = 4000.0;  // N/m
constexpr double kStiffnessWithoutTorque = 10.0;   // Nm/rad

FingerCommand command_of(FingerKind kind) {
  switch (kind) {
    case FingerKind::kJointLimit:
      return FingerCommand::kJointLimit;
    case FingerKind::kCurlLimit:
      return FingerCommand::kCurlLimit;
    case FingerKind::kBrake:
      return FingerCommand::kBrake;
    default:
      return FingerCommand::kTorque;
  }
}

/// Time constant of the actuator's torque, s.
double lag_of(const ActuatorModel& actuator) {
  return 1.0 / (2.0 * std::numbers::pi * actuator.bandwidth);
}

std::bitset<hands::kJoints> undriven_joints(const GloveModel& model) {
  std::bitset<hands::kJoints> undriven;
  if (model.fingers == FingerKind::kIdeal || model.fingers == FingerKind::kAbsent) return undriven;
  undriven.set();
  if (has_section(model, ModelSection::kActuator)) {
    for (std::size_t i = 0; i < hands::kJoints; ++i)
      undriven[i] = !model.actuator.is_driven[i];
  }
  if (model.fingers == FingerKind::kCurlLimit) {
    for (const auto& finger : kFlexionsOfFingers) {
      for (const std::size_t joint : finger)
        undriven.reset(joint);
    }
  }
  return undriven;
}

void describe_fingers(const GloveModel& model, DeviceDescriptor& descriptor) {
  const FingerKind kind = model.fingers;
  descriptor.finger_command = command_of(kind);
  descriptor.undriven_joints = undriven_joints(model);
  if (kind != FingerKind::kAbsent) {
    for (std::size_t i = 0; i < hands::kJoints; ++i) {
      descriptor.joint_lower[i] = radians(hands::kJointRanges[i].lower_deg);
      descriptor.joint_upper[i] = radians(hands::kJointRanges[i].upper_deg);
    }
  }
  if (kind == FingerKind::kIdeal) {
    descriptor.max_joint_torque = model.max_joint_torque;
    descriptor.joint_damping = model.joint_damping;
  }
  if (has_section(model, ModelSection::kSensor))
    descriptor.joint_resolution = std::max(model.sensor.resolution, model.sensor.noise);
  if (has_section(model, ModelSection::kActuator)) {
    descriptor.max_joint_torque = model.actuator.motor_torque + model.actuator.brake_torque;
    // A brake is passive with any stiffness. Its friction, if reported, would limit the stiffness to that of a motor.
    if (kind != FingerKind::kBrake) descriptor.joint_damping = model.actuator.viscous_friction;
    descriptor.joint_friction = model.actuator.coulomb_friction;
  }
  if (kind == FingerKind::kCurlLimit) descriptor.max_joint_torque = model.string.torque;
  if (kind == FingerKind::kTorque) descriptor.delay += nanoseconds_of(model.servo.delay + lag_of(model.actuator));
  if (descriptor.finger_command == FingerCommand::kTorque) return;
  const double lag = kind == FingerKind::kCurlLimit ? 0.0 : lag_of(model.actuator);
  descriptor.limit_rate = model.servo.rate;
  descriptor.limit_delay = nanoseconds_of(model.servo.delay + lag);
  descriptor.max_limit_stiffness = model.servo.max_stiffness;
  descriptor.joint_resolution = model.servo.resolution;  // of the loop, which holds the limits
}

}  // namespace

void validate(const GloveModel& model) {
  GloveModel copy = model;
  const auto refuse = [&model](const std::string& sentence) {
    throw std::invalid_argument("Glove model '" + model.name + "': " + sentence + ".");
  };
  for (const ModelNumber& number : numbers_of(copy)) {
    const bool is_fine = *number.value >= number.least && *number.value <= number.most;
    if (is_fine || !has_section(model, number.section)) continue;
    const std::string section(key_of(number.section));
    refuse(section + (section.empty() ? "" : ".") + std::string(number.key) + " " +
           out_of_range(number, *number.value));
  }
  const std::string contradiction = contradiction_in(model);
  if (!contradiction.empty()) refuse(contradiction);
}

DeviceDescriptor descriptor_of(const GloveModel& model) {
  DeviceDescriptor descriptor;
  descriptor.name = model.name;
  descriptor.update_rate = model.update_rate;
  // The haptic loop sees only late states: it cannot tell the time on the model's link from a difference of clocks.
  const double on_link = 2.0 * (model.link.delay + model.link.jitter);
  descriptor.delay = nanoseconds_of(model.measurement_delay + on_link);
  const WristModel& wrist = model.wrist;
  descriptor.resolution = wrist.position_noise;
  if (wrist.is_grounded) {
    descriptor.max_force = wrist.max_force;
    descriptor.max_torque = wrist.max_torque;
    descriptor.max_stiffness = wrist.max_stiffness;
    descriptor.max_rotational_stiffness = wrist.max_rotational_stiffness;
    descriptor.max_damping = wrist.max_damping;
    descriptor.damping = wrist.damping;
    descriptor.rotational_damping = wrist.rotational_damping;
  }
  if (wrist.holds_half_spaces) {
    descriptor.tool_command = ToolCommand::kHalfSpaces;
    descriptor.tool_rate = wrist.loop_rate;
    descriptor.tool_delay = nanoseconds_of(wrist.loop_delay);
  }
  // What exerts nothing cannot shake. A server then couples the part to the hand as for the ideal arm.
  if (descriptor.max_force == 0.0) descriptor.max_stiffness = kStiffnessWithoutForce;
  if (descriptor.max_torque == 0.0) descriptor.max_rotational_stiffness = kStiffnessWithoutTorque;
  describe_fingers(model, descriptor);
  constexpr std::chrono::seconds kLongestDelay{1};  // that a descriptor permits
  descriptor.delay = std::min<std::chrono::nanoseconds>(descriptor.delay, kLongestDelay);
  return descriptor;
}

}  // namespace glissade::devices

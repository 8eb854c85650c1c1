#include "lcm/glove_messages.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/glove_info_t.hpp>
#include <glissade/lcmtypes/glove_state_t.hpp>

#include "descriptor/bad_field.h"
#include "lcm/constraint_messages.h"
#include "lcm/message_fields.h"

namespace glissade::devices {
namespace {

DecodeResult check(const glove_state_t& message) noexcept {
  FieldCheck fields;
  fields.positive("session", message.session);
  fields.not_negative("leaseholder", message.leaseholder);
  fields.not_negative("sequence", message.sequence);
  fields.time("time_ns", message.time_ns);
  fields.between("side", message.side, 0, glove_state_t::SIDE_RIGHT);
  fields.between("enabled", message.enabled, 0, 1);
  fields.not_negative("grip", message.grip);
  fields.magnitude("position_WH_m", message.position_WH_m, kLargestPosition);
  fields.unit_vector("orientation_WH_wxyz", message.orientation_WH_wxyz);
  fields.magnitude("v_WH_m_per_s", message.v_WH_m_per_s, kLargestVelocity);
  fields.magnitude("w_WH_rad_per_s", message.w_WH_rad_per_s, kLargestAngularVelocity);
  fields.magnitude("joint_angles_rad", message.joint_angles_rad, kLargestAngle);
  fields.time("link_delay_ns", message.link_delay_ns);
  fields.magnitude("energy_J", message.energy_J, kLargestEnergy);
  fields.magnitude("taken_J", message.taken_J, kLargestEnergy);
  return fields.result();
}

DecodeResult check(const glove_command_t& message) noexcept {
  FieldCheck fields;
  fields.not_negative("glove_session", message.glove_session);
  fields.positive("session", message.session);
  fields.not_negative("sequence", message.sequence);
  fields.not_negative("state_sequence", message.state_sequence);
  fields.time("state_time_ns", message.state_time_ns);
  fields.time("time_ns", message.time_ns);
  fields.magnitude("force_H_W_N", message.force_H_W_N, kLargestForce);
  fields.magnitude("torque_H_W_Nm", message.torque_H_W_Nm, kLargestTorque);
  fields.magnitude("joint_torques_Nm", message.joint_torques_Nm, kLargestTorque);
  for (const joint_limit_t& limit : message.joint_limits) {
    fields.magnitude("joint_limits.lower_rad", limit.lower_rad, kNoLimit_rad);
    fields.magnitude("joint_limits.upper_rad", limit.upper_rad, kNoLimit_rad);
    fields.magnitude("joint_limits.stiffness_Nm_per_rad", limit.stiffness_Nm_per_rad, kLargestTorque);
    fields.magnitude("joint_limits.damping_Nm_s_per_rad", limit.damping_Nm_s_per_rad, kLargestTorque);
    fields.magnitude("joint_limits.max_torque_Nm", limit.max_torque_Nm, kLargestTorque);
  }
  fields.time("limits_expire_ns", message.limits_expire_ns);
  check_half_spaces(message.half_spaces, fields);
  fields.magnitude("supply_J", message.supply_J, kLargestEnergy);
  return fields.result();
}

/// The fields of a descriptor that are numbers, in the message and here.
template <typename Message, typename Descriptor, typename Use>
void for_each_limit(Message& message, Descriptor& descriptor, const Use& use) {
  use(message.max_force_N, descriptor.max_force);
  use(message.max_torque_Nm, descriptor.max_torque);
  use(message.max_stiffness_N_per_m, descriptor.max_stiffness);
  use(message.max_rotational_stiffness_Nm_per_rad, descriptor.max_rotational_stiffness);
  use(message.max_damping_N_s_per_m, descriptor.max_damping);
  use(message.max_joint_torque_Nm, descriptor.max_joint_torque);
  use(message.damping_N_s_per_m, descriptor.damping);
  use(message.rotational_damping_Nm_s_per_rad, descriptor.rotational_damping);
  use(message.joint_damping_Nm_s_per_rad, descriptor.joint_damping);
  use(message.friction_N, descriptor.friction);
  use(message.joint_friction_Nm, descriptor.joint_friction);
  use(message.resolution_m, descriptor.resolution);
  use(message.joint_resolution_rad, descriptor.joint_resolution);
  use(message.max_force_rate_N_per_s, descriptor.max_force_rate);
  use(message.max_torque_rate_Nm_per_s, descriptor.max_torque_rate);
  use(message.max_joint_torque_rate_Nm_per_s, descriptor.max_joint_torque_rate);
  use(message.max_power_W, descriptor.max_power);
  use(message.max_mean_force_N, descriptor.max_mean_force);
  use(message.max_speed_m_per_s, descriptor.max_speed);
  use(message.max_turn_rate_rad_per_s, descriptor.max_turn_rate);
  use(message.workspace_radius_m, descriptor.workspace_radius);
  use(message.update_rate_Hz, descriptor.update_rate);
  use(message.limit_rate_Hz, descriptor.limit_rate);
  use(message.max_limit_stiffness_Nm_per_rad, descriptor.max_limit_stiffness);
  use(message.tool_rate_Hz, descriptor.tool_rate);
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    use(message.joint_lower_rad[i], descriptor.joint_lower[i]);
    use(message.joint_upper_rad[i], descriptor.joint_upper[i]);
  }
}

}  // namespace

std::vector<std::uint8_t> encode(const GloveInfo& info) {
  glove_info_t message{};
  message.version = glove_info_t::VERSION;
  message.side = static_cast<std::int32_t>(info.side);
  message.device = info.device;
  message.session = info.session;
  message.calibrated = info.is_calibrated ? 1 : 0;
  const std::string& name = info.descriptor.name;
  std::copy_n(name.begin(), std::min(name.size(), std::size(message.name) - 1), message.name);
  for_each_limit(message, info.descriptor, [](double& sent, double value) { sent = value; });
  message.frozen_ns = info.descriptor.frozen.count();
  message.delay_ns = info.descriptor.delay.count();
  message.finger_command = static_cast<std::int32_t>(info.descriptor.finger_command);
  message.limit_delay_ns = info.descriptor.limit_delay.count();
  message.undriven_joints = static_cast<std::int32_t>(info.descriptor.undriven_joints.to_ulong());
  message.tool_command = static_cast<std::int32_t>(info.descriptor.tool_command);
  message.tool_delay_ns = info.descriptor.tool_delay.count();
  return to_bytes(message);
}

std::vector<std::uint8_t> encode(const StateHeader& header, const GloveState& state) {
  glove_state_t message{};
  message.version = glove_state_t::VERSION;
  message.side = static_cast<std::int32_t>(header.side);
  message.device = header.device;
  message.session = header.session;
  message.leaseholder = header.leaseholder;
  message.enabled = state.is_enabled ? 1 : 0;
  message.grip = state.grip;
  message.sequence = state.sequence;
  message.time_ns = state.time.count();
  put(Eigen::Vector3d(state.X_WH.translation()), message.position_WH_m);
  put(Eigen::Matrix3d(state.X_WH.linear()), message.orientation_WH_wxyz);
  put(state.v_WH, message.v_WH_m_per_s);
  put(state.w_WH, message.w_WH_rad_per_s);
  std::copy(state.joint_angles.begin(), state.joint_angles.end(), message.joint_angles_rad);
  message.reasons = to_bits(state.limits);
  message.link_delay_ns = state.link_delay.count();
  message.energy_J = state.energy;
  message.taken_J = state.taken.value_or(0.0);
  message.command_age_ns = state.command_age.count();
  return to_bytes(message);
}

std::vector<std::uint8_t> encode(const CommandHeader& header, const GloveCommand& command) {
  glove_command_t message{};
  message.version = glove_command_t::VERSION;
  message.device = header.device;
  message.glove_session = header.glove_session;
  message.session = header.session;
  message.state_time_ns = command.state_time.count();
  message.sequence = command.sequence;
  message.state_sequence = command.state_sequence;
  message.time_ns = command.time.count();
  put(command.f_H_W, message.force_H_W_N);
  put(command.t_H_W, message.torque_H_W_Nm);
  message.supply_J = command.supply;
  std::copy(command.joint_torques.begin(), command.joint_torques.end(), message.joint_torques_Nm);
  for (std::size_t j = 0; j < hands::kJoints; ++j)
    message.joint_limits[j] = limit_message(command.joint_limits.joints[j]);
  message.limits_expire_ns = command.joint_limits.expiry.count();
  message.half_spaces = half_spaces_message(command.half_spaces);
  return to_bytes(message);
}

DecodeResult decode(std::span<const std::uint8_t> bytes, GloveInfo& info) noexcept {
  glove_info_t message{};
  const DecodeResult whole = from_bytes(bytes, message);
  if (whole != MessageError::kNone) return whole;
  FieldCheck fields;
  fields.positive("session", message.session);
  fields.time("frozen_ns", message.frozen_ns);
  fields.time("delay_ns", message.delay_ns);
  fields.time("limit_delay_ns", message.limit_delay_ns);
  fields.between("finger_command", message.finger_command, 0, kFingerCommands - 1);
  fields.between("undriven_joints", message.undriven_joints, 0, (1 << hands::kJoints) - 1);
  fields.between("tool_command", message.tool_command, 0, kToolCommands - 1);
  fields.time("tool_delay_ns", message.tool_delay_ns);
  fields.between("side", message.side, 0, glove_state_t::SIDE_RIGHT);
  fields.between("calibrated", message.calibrated, 0, 1);
  fields.between("name", message.name[std::size(message.name) - 1], 0, 0);
  DeviceDescriptor descriptor;
  for_each_limit(message, descriptor, [](double sent, double& value) { value = sent; });
  descriptor.frozen = std::chrono::nanoseconds(message.frozen_ns);
  descriptor.delay = std::chrono::nanoseconds(message.delay_ns);
  descriptor.limit_delay = std::chrono::nanoseconds(message.limit_delay_ns);
  descriptor.finger_command = FingerCommand{message.finger_command};
  descriptor.undriven_joints = static_cast<unsigned long>(message.undriven_joints);
  descriptor.tool_command = ToolCommand{message.tool_command};
  descriptor.tool_delay = std::chrono::nanoseconds(message.tool_delay_ns);
  if (fields.result() != MessageError::kNone) return fields.result();
  if (const std::optional<BadField> bad = first_bad_field(descriptor))
    return {MessageError::kOutOfRange, {.name = bad->name, .value = bad->value}};
  descriptor.name = reinterpret_cast<const char*>(message.name);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  std::replace_if(descriptor.name.begin(), descriptor.name.end(), is_control, '?');
  info = {.device = message.device,
          .session = message.session,
          .side = hands::HandSide{message.side},
          .descriptor = std::move(descriptor),
          .is_calibrated = message.calibrated != 0};
  return MessageError::kNone;
}

DecodeResult decode(std::span<const std::uint8_t> bytes, StateHeader& header, GloveState& state) noexcept {
  glove_state_t message{};
  DecodeResult result = from_bytes(bytes, message);
  if (result == MessageError::kNone) result = check(message);
  if (result != MessageError::kNone) return result;
  header = {message.device, message.session, message.leaseholder, static_cast<hands::HandSide>(message.side)};
  state.is_enabled = message.enabled != 0;
  state.grip = message.grip;
  state.sequence = message.sequence;
  state.time = std::chrono::nanoseconds(message.time_ns);
  state.X_WH = pose_of(message.position_WH_m, message.orientation_WH_wxyz);
  state.v_WH = Eigen::Vector3d(message.v_WH_m_per_s);
  state.w_WH = Eigen::Vector3d(message.w_WH_rad_per_s);
  std::copy_n(message.joint_angles_rad, hands::kJoints, state.joint_angles.begin());
  state.limits = limit_reasons_from_bits(message.reasons);
  state.link_delay = std::chrono::nanoseconds(message.link_delay_ns);
  state.energy = message.energy_J;
  state.taken = message.taken_J;
  state.command_age = std::chrono::nanoseconds(message.command_age_ns);
  return MessageError::kNone;
}

DecodeResult decode(std::span<const std::uint8_t> bytes, CommandHeader& header, GloveCommand& command) noexcept {
  glove_command_t message{};
  DecodeResult result = from_bytes(bytes, message);
  if (result == MessageError::kNone) result = check(message);
  if (result != MessageError::kNone) return result;
  header = {message.device, message.glove_session, message.session};
  command.state_time = std::chrono::nanoseconds(message.state_time_ns);
  command.session = message.session;
  command.sequence = message.sequence;
  command.state_sequence = message.state_sequence;
  command.time = std::chrono::nanoseconds(message.time_ns);
  command.f_H_W = Eigen::Vector3d(message.force_H_W_N);
  command.t_H_W = Eigen::Vector3d(message.torque_H_W_Nm);
  std::copy_n(message.joint_torques_Nm, hands::kJoints, command.joint_torques.begin());
  for (std::size_t j = 0; j < hands::kJoints; ++j)
    command.joint_limits.joints[j] = limit_of(message.joint_limits[j]);
  command.joint_limits.expiry = std::chrono::nanoseconds(message.limits_expire_ns);
  command.half_spaces = half_spaces_of(message.half_spaces);
  command.supply = message.supply_J;
  return MessageError::kNone;
}

}  // namespace glissade::devices

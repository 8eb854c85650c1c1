#include "lcm/glove_messages.h"

#include <algorithm>
#include <utility>

#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/glove_info_t.hpp>
#include <glissade/lcmtypes/glove_state_t.hpp>

#include "lcm/message_fields.h"

namespace glissade::devices {
namespace {

MessageError check(const glove_state_t& message) noexcept {
  FieldCheck fields;
  fields.positive(message.session);
  fields.not_negative(message.leaseholder);
  fields.not_negative(message.sequence);
  fields.time(message.time_ns);
  fields.between(message.side, 0, glove_state_t::SIDE_RIGHT);
  fields.between(message.enabled, 0, 1);
  fields.not_negative(message.grip);
  fields.magnitude(message.position_WH_m, kLargestPosition);
  fields.unit_quaternion(message.orientation_WH_wxyz);
  fields.magnitude(message.v_WH_m_per_s, kLargestVelocity);
  fields.magnitude(message.w_WH_rad_per_s, kLargestAngularVelocity);
  fields.magnitude(message.joint_angles_rad, kLargestAngle);
  fields.time(message.link_delay_ns);
  fields.magnitude(message.energy_J, kLargestEnergy);
  fields.magnitude(message.taken_J, kLargestEnergy);
  return fields.result();
}

MessageError check(const glove_command_t& message) noexcept {
  FieldCheck fields;
  fields.not_negative(message.glove_session);
  fields.positive(message.session);
  fields.not_negative(message.sequence);
  fields.not_negative(message.state_sequence);
  fields.time(message.state_time_ns);
  fields.time(message.time_ns);
  fields.magnitude(message.force_H_W_N, kLargestForce);
  fields.magnitude(message.torque_H_W_Nm, kLargestTorque);
  fields.magnitude(message.joint_torques_Nm, kLargestTorque);
  fields.magnitude(message.supply_J, kLargestEnergy);
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
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    use(message.joint_lower_rad[i], descriptor.joint_lower[i]);
    use(message.joint_upper_rad[i], descriptor.joint_upper[i]);
  }
}

bool is_valid(const DeviceDescriptor& descriptor) noexcept {
  try {
    validate(descriptor);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::vector<std::uint8_t> encode(const GloveInfo& info) {
  glove_info_t message{};
  message.version = glove_info_t::VERSION;
  message.side = static_cast<std::int32_t>(info.side);
  message.device = info.device;
  message.session = info.session;
  const std::string& name = info.descriptor.name;
  std::copy_n(name.begin(), std::min(name.size(), std::size(message.name) - 1), message.name);
  for_each_limit(message, info.descriptor, [](double& sent, double value) { sent = value; });
  message.frozen_ns = info.descriptor.frozen.count();
  message.delay_ns = info.descriptor.delay.count();
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
  return to_bytes(message);
}

MessageError decode(std::span<const std::uint8_t> bytes, GloveInfo& info) noexcept {
  glove_info_t message{};
  const MessageError error = from_bytes(bytes, message);
  if (error != MessageError::kNone) return error;
  if (message.version != glove_info_t::VERSION) return MessageError::kWrongVersion;
  FieldCheck fields;
  fields.positive(message.session);
  fields.time(message.frozen_ns);
  fields.time(message.delay_ns);
  fields.between(message.side, 0, glove_state_t::SIDE_RIGHT);
  fields.between(message.name[std::size(message.name) - 1], 0, 0);
  DeviceDescriptor descriptor;
  for_each_limit(message, descriptor, [](double sent, double& value) { value = sent; });
  descriptor.frozen = std::chrono::nanoseconds(message.frozen_ns);
  descriptor.delay = std::chrono::nanoseconds(message.delay_ns);
  if (fields.result() != MessageError::kNone || !is_valid(descriptor)) return MessageError::kOutOfRange;
  descriptor.name = reinterpret_cast<const char*>(message.name);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  std::replace_if(descriptor.name.begin(), descriptor.name.end(), is_control, '?');
  info = {.device = message.device,
          .session = message.session,
          .side = hands::HandSide{message.side},
          .descriptor = std::move(descriptor)};
  return MessageError::kNone;
}

MessageError decode(std::span<const std::uint8_t> bytes, StateHeader& header, GloveState& state) noexcept {
  glove_state_t message{};
  MessageError error = from_bytes(bytes, message);
  if (error == MessageError::kNone && message.version != decltype(message)::VERSION)
    error = MessageError::kWrongVersion;
  if (error == MessageError::kNone) error = check(message);
  if (error != MessageError::kNone) return error;
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

MessageError decode(std::span<const std::uint8_t> bytes, CommandHeader& header, GloveCommand& command) noexcept {
  glove_command_t message{};
  MessageError error = from_bytes(bytes, message);
  if (error == MessageError::kNone && message.version != decltype(message)::VERSION)
    error = MessageError::kWrongVersion;
  if (error == MessageError::kNone) error = check(message);
  if (error != MessageError::kNone) return error;
  header = {message.device, message.glove_session, message.session};
  command.state_time = std::chrono::nanoseconds(message.state_time_ns);
  command.session = message.session;
  command.sequence = message.sequence;
  command.state_sequence = message.state_sequence;
  command.time = std::chrono::nanoseconds(message.time_ns);
  command.f_H_W = Eigen::Vector3d(message.force_H_W_N);
  command.t_H_W = Eigen::Vector3d(message.torque_H_W_Nm);
  std::copy_n(message.joint_torques_Nm, hands::kJoints, command.joint_torques.begin());
  command.supply = message.supply_J;
  return MessageError::kNone;
}

}  // namespace glissade::devices

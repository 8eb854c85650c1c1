#include <glissade/lcmtypes/haptic_tick_t.hpp>

#include "record/message_bytes.h"
#include "record/pose_message.h"
#include "record/record_messages.h"

namespace glissade::haptics {

namespace {

void put_state(const devices::GloveState& state, tick_hand_t& message) {
  message.has_state = 1;
  message.state_sequence = state.sequence;
  message.state_time_ns = state.time.count();
  message.X_WH = pose_message(state.X_WH);
  put(state.v_WH.data(), message.v_WH_m_per_s);
  put(state.w_WH.data(), message.w_WH_rad_per_s);
  put(state.joint_angles.data(), message.joint_angles_rad);
  message.grip = state.grip;
  message.enabled = state.is_enabled ? 1 : 0;
  message.obeys_another = state.obeys_another ? 1 : 0;
  message.glove_reasons = devices::to_bits(state.limits);
  message.glove_command_age_ns = state.command_age.count();
  message.link_delay_ns = state.link_delay.count();
  message.glove_energy_J = state.energy;
  message.glove_taken_J = state.taken.value_or(-1.0);
}

devices::GloveState state_of(const tick_hand_t& message) {
  devices::GloveState state;
  state.sequence = message.state_sequence;
  state.time = std::chrono::nanoseconds(message.state_time_ns);
  state.X_WH = pose_of(message.X_WH);
  state.v_WH = vector_of(message.v_WH_m_per_s);
  state.w_WH = vector_of(message.w_WH_rad_per_s);
  std::copy_n(message.joint_angles_rad, state.joint_angles.size(), state.joint_angles.begin());
  state.grip = message.grip;
  state.is_enabled = message.enabled != 0;
  state.obeys_another = message.obeys_another != 0;
  state.limits = devices::limit_reasons_from_bits(message.glove_reasons);
  state.command_age = std::chrono::nanoseconds(message.glove_command_age_ns);
  state.link_delay = std::chrono::nanoseconds(message.link_delay_ns);
  state.energy = message.glove_energy_J;
  if (message.glove_taken_J >= 0.0) state.taken = message.glove_taken_J;
  return state;
}

void put_command(const devices::SafeCommand& safe, tick_hand_t& message) {
  const devices::GloveCommand& command = safe.values();
  message.command_sequence = command.sequence;
  message.answered_sequence = command.state_sequence;
  message.answered_time_ns = command.state_time.count();
  message.command_time_ns = command.time.count();
  put(command.f_H_W.data(), message.force_H_W_N);
  put(command.t_H_W.data(), message.torque_H_W_Nm);
  put(command.joint_torques.data(), message.joint_torques_Nm);
  message.supply_J = command.supply;
  message.reasons = devices::to_bits(safe.reasons());
  message.state_age_ns = safe.age().count();
  message.energy_J = safe.energy();
}

/// Devices that take torques get no limits, and their ticks carry none.
void put_limits(const devices::JointLimits& limits, tick_hand_t& hand, haptic_tick_t& message) {
  hand.has_limits = limits.any() ? 1 : 0;
  hand.limits_expire_ns = limits.expiry.count();
  if (!limits.any()) return;
  for (const devices::JointLimit& limit : limits.joints) {
    joint_limit_t& entry = message.limits.emplace_back();
    entry.lower_rad = limit.lower;
    entry.upper_rad = limit.upper;
    entry.stiffness_Nm_per_rad = limit.stiffness;
    entry.damping_Nm_s_per_rad = limit.damping;
    entry.max_torque_Nm = limit.max_torque;
  }
}

/// Devices that take a wrench get no half-spaces, and their ticks carry none.
void put_half_spaces(const devices::HalfSpaces& half_spaces, tick_hand_t& hand, haptic_tick_t& message) {
  hand.has_half_spaces = half_spaces.any() ? 1 : 0;
  if (!half_spaces.any()) return;
  half_spaces_t& entry = message.half_spaces.emplace_back(half_spaces_t{});
  const Eigen::Vector3d p_WB = half_spaces.X_WB.translation();
  const Eigen::Quaterniond q_WB(half_spaces.X_WB.linear());
  put(p_WB.data(), entry.position_WB_m);
  put(Eigen::Vector4d(q_WB.w(), q_WB.x(), q_WB.y(), q_WB.z()).eval().data(), entry.orientation_WB_wxyz);
  put(half_spaces.p_HR.data(), entry.position_HR_m);
  entry.count = static_cast<std::int32_t>(half_spaces.count);
  for (std::size_t i = 0; i < half_spaces.count; ++i) {
    const devices::HalfSpace& row = half_spaces.rows[i];
    put(row.n_W.data(), entry.rows[i].n_W);
    put(row.r_W.data(), entry.rows[i].r_W_m);
    entry.rows[i].bound_m = row.bound;
  }
  entry.stiffness_N_per_m = half_spaces.stiffness;
  entry.rotational_stiffness_Nm_per_rad = half_spaces.rotational_stiffness;
  entry.damping_N_s_per_m = half_spaces.damping;
  entry.max_force_N = half_spaces.max_force;
  entry.max_torque_Nm = half_spaces.max_torque;
  entry.expire_ns = half_spaces.expiry.count();
}

haptic_tick_t message_of(const TickRecord& record) {
  haptic_tick_t message{};
  message.version = haptic_tick_t::VERSION;
  message.number = record.number;
  message.sequence = record.sequence;
  message.deadline_ns = record.deadline.count();
  message.time_ns = record.time.count();
  message.duration_ns = record.duration.count();
  message.stopped = record.is_stopped ? 1 : 0;
  message.set_sequence = record.set_sequence;
  for (const HoldRequest& request : record.requests.all()) {
    hold_request_t& entry = message.requests.emplace_back();
    entry.hand = request.hand;
    entry.part = request.part;
  }
  for (std::size_t h = 0; h < static_cast<std::size_t>(record.hand_count); ++h) {
    tick_hand_t& hand = message.hands.emplace_back();
    if (!record.has_state[h]) continue;
    put_state(record.states[h], hand);
    put_command(record.tick.hands[h].command, hand);
    const devices::GloveCommand& command = record.tick.hands[h].command.values();
    put_limits(command.joint_limits, hand, message);
    put_half_spaces(command.half_spaces, hand, message);
  }
  for (std::size_t p = 0; p < static_cast<std::size_t>(record.part_count); ++p)
    message.ghosts.push_back(ghost_message(record.tick.ghosts.parts[p]));
  message.request_count = static_cast<std::int32_t>(message.requests.size());
  message.hand_count = record.hand_count;
  message.part_count = record.part_count;
  message.limit_count = static_cast<std::int32_t>(message.limits.size());
  message.half_spaces_count = static_cast<std::int32_t>(message.half_spaces.size());
  return message;
}

}  // namespace

std::vector<std::uint8_t> encode(const TickRecord& record) {
  haptic_tick_t message = message_of(record);
  return to_checked_bytes(message);
}

bool is_message_of(const TickRecord& record, std::span<const std::uint8_t> bytes) {
  return is_of(bytes, message_of(record));
}

std::optional<TickRecord> decode_tick(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::int32_t, 5> kLargest{HoldRequests::kMost, hands::kMaxHands, contact::kMaxParts,
                                                 hands::kMaxHands * hands::kJoints, hands::kMaxHands};
  const auto message = from_checked_bytes<haptic_tick_t>(bytes, kLargest);
  if (!message) return std::nullopt;
  TickRecord record;
  record.number = message->number;
  record.sequence = message->sequence;
  record.deadline = std::chrono::nanoseconds(message->deadline_ns);
  record.time = std::chrono::nanoseconds(message->time_ns);
  record.duration = std::chrono::nanoseconds(message->duration_ns);
  record.is_stopped = message->stopped != 0;
  record.set_sequence = message->set_sequence;
  record.hand_count = message->hand_count;
  for (const hold_request_t& request : message->requests)
    record.requests.add({request.hand, request.part});
  for (std::size_t h = 0; h < message->hands.size(); ++h) {
    record.has_state[h] = message->hands[h].has_state != 0;
    if (record.has_state[h]) record.states[h] = state_of(message->hands[h]);
  }
  return record;
}

}  // namespace glissade::haptics

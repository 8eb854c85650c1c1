#include "lcm/glove_messages.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glissade/lcmtypes/glove_command_t.hpp>
#include <glissade/lcmtypes/glove_info_t.hpp>
#include <glissade/lcmtypes/glove_state_t.hpp>
#include <glissade/lcmtypes/haptic_contact_t.hpp>
#include <glissade/lcmtypes/haptic_hand_t.hpp>
#include <glissade/lcmtypes/haptic_part_t.hpp>
#include <glissade/lcmtypes/haptic_patch_t.hpp>
#include <glissade/lcmtypes/haptic_state_t.hpp>

namespace glissade::devices {
namespace {

// Numbers beyond these limits are errors of the sender, for any device.
constexpr double kLargestPosition = 1e3;         // m
constexpr double kLargestVelocity = 1e3;         // m/s
constexpr double kLargestAngularVelocity = 1e4;  // rad/s
constexpr double kLargestAngle = 2.0 * std::numbers::pi;
constexpr double kLargestForce = 1e6;   // N
constexpr double kLargestTorque = 1e6;  // Nm
constexpr double kLargestEnergy = 1e9;  // J
constexpr double kLargestNormal = 1.001;
constexpr std::int32_t kAllSegments = (1 << 24) - 1;
constexpr double kQuaternionTolerance = 1e-3;
constexpr std::int64_t kLargestTime_ns = std::int64_t{1} << 60;  // 36 years

static_assert(haptic_hand_t::REASON_STOPPED == 1);
static_assert(haptic_hand_t::REASON_ENERGY == 1 << (kLimitReasons.size() - 1));

void put(const Eigen::Vector3d& vector, double (&out)[3]) {
  std::copy_n(vector.data(), 3, out);
}

void put(const Eigen::Vector3f& vector, float (&out)[3]) {
  std::copy_n(vector.data(), 3, out);
}

void put(const Eigen::Matrix3d& R, double (&wxyz)[4]) {
  const Eigen::Quaterniond q(R);
  wxyz[0] = q.w();
  wxyz[1] = q.x();
  wxyz[2] = q.y();
  wxyz[3] = q.z();
}

Eigen::Isometry3d pose_of(const double (&position_m)[3], const double (&wxyz)[4]) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(position_m);
  X.linear() = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
  return X;
}

template <typename Message>
std::vector<std::uint8_t> to_bytes(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <typename Message>
MessageError from_bytes(std::span<const std::uint8_t> bytes, Message& message) noexcept {
  const int size = message.getEncodedSize();
  if (bytes.size() != static_cast<std::size_t>(size)) return MessageError::kWrongSize;
  return message.decode(bytes.data(), 0, size) == size ? MessageError::kNone : MessageError::kUndecodable;
}

/// Checks the fields of a message and keeps the most serious error.
class FieldCheck {
 public:
  template <typename Number, std::size_t N>
  void magnitude(const Number (&values)[N], double largest) noexcept {
    for (const Number number : values) {
      const auto value = static_cast<double>(number);
      is_finite_ = is_finite_ && std::isfinite(value);
      is_in_range_ = is_in_range_ && std::abs(value) <= largest;
    }
  }
  void magnitude(double value, double largest) noexcept {
    const double values[] = {value};
    magnitude(values, largest);
  }
  void unit_quaternion(const double (&wxyz)[4]) noexcept {
    magnitude(wxyz, 2.0);
    const double norm = Eigen::Vector4d(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).norm();
    is_in_range_ = is_in_range_ && std::abs(norm - 1.0) <= kQuaternionTolerance;
  }
  void not_negative(std::int64_t value) noexcept { is_in_range_ = is_in_range_ && value >= 0; }
  void positive(std::int64_t value) noexcept { is_in_range_ = is_in_range_ && value > 0; }
  void time(std::int64_t ns) noexcept { is_in_range_ = is_in_range_ && ns >= 0 && ns <= kLargestTime_ns; }
  void between(std::int32_t value, std::int32_t least, std::int32_t largest) noexcept {
    is_in_range_ = is_in_range_ && value >= least && value <= largest;
  }

  MessageError result() const noexcept {
    if (!is_finite_) return MessageError::kNotFinite;
    return is_in_range_ ? MessageError::kNone : MessageError::kOutOfRange;
  }

 private:
  bool is_finite_ = true;
  bool is_in_range_ = true;
};

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
  use(message.resolution_m, descriptor.resolution);
  use(message.max_force_rate_N_per_s, descriptor.max_force_rate);
  use(message.max_torque_rate_Nm_per_s, descriptor.max_torque_rate);
  use(message.max_joint_torque_rate_Nm_per_s, descriptor.max_joint_torque_rate);
  use(message.max_power_W, descriptor.max_power);
  use(message.max_mean_force_N, descriptor.max_mean_force);
  use(message.max_speed_m_per_s, descriptor.max_speed);
  use(message.max_turn_rate_rad_per_s, descriptor.max_turn_rate);
  use(message.workspace_radius_m, descriptor.workspace_radius);
  use(message.update_rate_Hz, descriptor.update_rate);
  for (std::size_t i = 0; i < kGloveJoints; ++i) {
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

MessageError check(const haptic_state_t& message) noexcept {
  FieldCheck fields;
  fields.not_negative(message.sequence);
  fields.time(message.time_ns);
  fields.time(message.contact_set_age_ns);
  fields.between(message.part_count, 0, static_cast<std::int32_t>(kHapticParts));
  fields.between(message.hand_count, 0, static_cast<std::int32_t>(kHapticHands));
  fields.between(message.contact_count, 0, static_cast<std::int32_t>(kHapticContacts));
  fields.between(message.patch_count, 0, static_cast<std::int32_t>(kHapticPatches));
  fields.not_negative(message.patches_left_out);
  fields.time(message.lateness_ns);
  fields.time(message.last_duration_ns);
  for (const haptic_part_t& part : message.parts) {
    fields.magnitude(part.position_WG_m, kLargestPosition);
    fields.unit_quaternion(part.orientation_WG_wxyz);
    fields.magnitude(part.position_WV_m, kLargestPosition);
    fields.unit_quaternion(part.orientation_WV_wxyz);
    fields.not_negative(part.contact_count);
  }
  for (const haptic_hand_t& hand : message.hands) {
    fields.between(hand.part, -1, static_cast<std::int32_t>(kHapticParts) - 1);
    fields.magnitude(hand.force_W_N, kLargestForce);
    fields.magnitude(hand.torque_V_W_Nm, kLargestTorque);
    fields.magnitude(hand.contact_share, 1.0);
    fields.magnitude(hand.energy_J, kLargestEnergy);
    fields.magnitude(hand.glove_energy_J, kLargestEnergy);
    fields.between(hand.touching, 0, kAllSegments);
    fields.magnitude(hand.position_WH_m, kLargestPosition);
    fields.unit_quaternion(hand.orientation_WH_wxyz);
    fields.magnitude(hand.joint_angles_rad, kLargestAngle);
    fields.magnitude(hand.joint_torques_Nm, kLargestTorque);
  }
  for (const haptic_contact_t& contact : message.contacts) {
    fields.between(contact.part, 0, static_cast<std::int32_t>(kHapticParts) - 1);
    fields.magnitude(contact.position_V_m, kLargestPosition);
    fields.magnitude(contact.normal_W, kLargestNormal);
  }
  for (const haptic_patch_t& patch : message.patches) {
    fields.between(patch.part, 0, static_cast<std::int32_t>(kHapticParts) - 1);
    fields.not_negative(patch.contact_count);
    fields.magnitude(patch.position_V_m, kLargestPosition);
    fields.magnitude(patch.normal_W, kLargestNormal);
    fields.magnitude(static_cast<double>(patch.extent_m), kLargestPosition);
  }
  return fields.result();
}

haptic_part_t message_of(const HapticPartState& part) {
  haptic_part_t message{};
  put(Eigen::Vector3d(part.X_WG.translation()), message.position_WG_m);
  put(Eigen::Matrix3d(part.X_WG.linear()), message.orientation_WG_wxyz);
  put(Eigen::Vector3d(part.X_WV.translation()), message.position_WV_m);
  put(Eigen::Matrix3d(part.X_WV.linear()), message.orientation_WV_wxyz);
  message.part_state = static_cast<std::int32_t>(part.state);
  message.contact_count = part.contact_count;
  return message;
}

HapticPartState part_of(const haptic_part_t& message) noexcept {
  return {.X_WG = pose_of(message.position_WG_m, message.orientation_WG_wxyz),
          .X_WV = pose_of(message.position_WV_m, message.orientation_WV_wxyz),
          .state = part_state_from_number(message.part_state),
          .contact_count = message.contact_count};
}

haptic_hand_t message_of(const HapticHandState& hand) {
  haptic_hand_t message{};
  message.part = hand.part;
  message.flags = hand.are_contacts_unsolved ? haptic_hand_t::FLAG_CONTACTS_UNSOLVED : 0;
  message.reasons = to_bits(hand.reasons);
  message.glove_reasons = to_bits(hand.glove_reasons);
  put(hand.force_W, message.force_W_N);
  put(hand.torque_V_W, message.torque_V_W_Nm);
  message.contact_share = hand.contact_share;
  message.command_age_ns = hand.command_age.count();
  message.state_age_ns = hand.state_age.count();
  message.energy_J = hand.energy;
  message.glove_energy_J = hand.glove_energy;
  message.activity = static_cast<std::int32_t>(hand.visible.activity);
  message.grasp = static_cast<std::int32_t>(hand.visible.grasp);
  message.form = static_cast<std::int32_t>(hand.visible.form);
  message.touching = hand.visible.touching;
  put(Eigen::Vector3d(hand.visible.X_WH.translation()), message.position_WH_m);
  put(Eigen::Matrix3d(hand.visible.X_WH.linear()), message.orientation_WH_wxyz);
  std::copy(hand.visible.angles.begin(), hand.visible.angles.end(), message.joint_angles_rad);
  std::copy(hand.joint_torques.begin(), hand.joint_torques.end(), message.joint_torques_Nm);
  return message;
}

haptic_contact_t message_of(const HapticContact& contact) {
  haptic_contact_t message{};
  message.part = contact.part;
  put(contact.p_V, message.position_V_m);
  put(contact.n_W, message.normal_W);
  return message;
}

HapticContact contact_of(const haptic_contact_t& message) noexcept {
  return {message.part, Eigen::Vector3f(message.position_V_m), Eigen::Vector3f(message.normal_W)};
}

haptic_patch_t message_of(const HapticPatch& patch) {
  haptic_patch_t message{};
  message.part = patch.part;
  message.contact_count = patch.contact_count;
  put(patch.p_V, message.position_V_m);
  put(patch.n_W, message.normal_W);
  message.extent_m = patch.extent;
  return message;
}

HapticPatch patch_of(const haptic_patch_t& message) noexcept {
  return {message.part, message.contact_count, Eigen::Vector3f(message.position_V_m), Eigen::Vector3f(message.normal_W),
          message.extent_m};
}

/// Zero for a number that has no meaning here.
template <typename Enumeration>
Enumeration enumeration_of(std::int32_t number, std::int32_t count) noexcept {
  return static_cast<Enumeration>(number >= 0 && number < count ? number : 0);
}

VisibleHand visible_hand_of(const haptic_hand_t& message) noexcept {
  VisibleHand visible{.activity = enumeration_of<HandActivity>(message.activity, kHandActivities),
                      .grasp = enumeration_of<GraspKind>(message.grasp, kGraspKinds),
                      .form = enumeration_of<GraspForm>(message.form, kGraspForms),
                      .touching = message.touching,
                      .X_WH = pose_of(message.position_WH_m, message.orientation_WH_wxyz)};
  std::copy_n(message.joint_angles_rad, kGloveJoints, visible.angles.begin());
  return visible;
}

HapticHandState hand_of(const haptic_hand_t& message) noexcept {
  HapticHandState hand{.part = message.part,
                       .force_W = Eigen::Vector3d(message.force_W_N),
                       .torque_V_W = Eigen::Vector3d(message.torque_V_W_Nm),
                       .contact_share = message.contact_share,
                       .are_contacts_unsolved = (message.flags & haptic_hand_t::FLAG_CONTACTS_UNSOLVED) != 0,
                       .reasons = limit_reasons_from_bits(message.reasons),
                       .state_age = std::chrono::nanoseconds(message.state_age_ns),
                       .glove_reasons = limit_reasons_from_bits(message.glove_reasons),
                       .command_age = std::chrono::nanoseconds(message.command_age_ns),
                       .energy = message.energy_J,
                       .glove_energy = message.glove_energy_J,
                       .visible = visible_hand_of(message)};
  std::copy_n(message.joint_torques_Nm, kGloveJoints, hand.joint_torques.begin());
  return hand;
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

std::vector<std::uint8_t> encode(const HapticState& state) {
  haptic_state_t message{};
  message.version = haptic_state_t::VERSION;
  message.sequence = state.sequence;
  message.time_ns = state.time.count();
  message.contact_set_age_ns = state.contact_set_age.count();
  message.flags = state.is_contact_set_late ? haptic_state_t::FLAG_CONTACT_SET_LATE : 0;
  message.part_count = state.part_count;
  message.hand_count = state.hand_count;
  message.lateness_ns = state.lateness.count();
  message.last_duration_ns = state.last_duration.count();
  message.contact_count = state.contact_count;
  for (std::size_t p = 0; p < kHapticParts; ++p)
    message.parts[p] = message_of(state.parts[p]);
  for (std::size_t h = 0; h < kHapticHands; ++h)
    message.hands[h] = message_of(state.hands[h]);
  for (std::size_t c = 0; c < kHapticContacts; ++c)
    message.contacts[c] = message_of(state.contacts[c]);
  message.patch_count = state.patch_count;
  message.patches_left_out = state.patches_left_out;
  for (std::size_t p = 0; p < kHapticPatches; ++p)
    message.patches[p] = message_of(state.patches[p]);
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
          .side = HandSide{message.side},
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
  header = {message.device, message.session, message.leaseholder, static_cast<HandSide>(message.side)};
  state.is_enabled = message.enabled != 0;
  state.grip = message.grip;
  state.sequence = message.sequence;
  state.time = std::chrono::nanoseconds(message.time_ns);
  state.X_WH = pose_of(message.position_WH_m, message.orientation_WH_wxyz);
  state.v_WH = Eigen::Vector3d(message.v_WH_m_per_s);
  state.w_WH = Eigen::Vector3d(message.w_WH_rad_per_s);
  std::copy_n(message.joint_angles_rad, kGloveJoints, state.joint_angles.begin());
  state.limits = limit_reasons_from_bits(message.reasons);
  state.link_delay = std::chrono::nanoseconds(message.link_delay_ns);
  state.energy = message.energy_J;
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
  command.sequence = message.sequence;
  command.state_sequence = message.state_sequence;
  command.time = std::chrono::nanoseconds(message.time_ns);
  command.f_H_W = Eigen::Vector3d(message.force_H_W_N);
  command.t_H_W = Eigen::Vector3d(message.torque_H_W_Nm);
  std::copy_n(message.joint_torques_Nm, kGloveJoints, command.joint_torques.begin());
  command.supply = message.supply_J;
  return MessageError::kNone;
}

MessageError decode(std::span<const std::uint8_t> bytes, HapticState& state) noexcept {
  haptic_state_t message{};
  MessageError error = from_bytes(bytes, message);
  if (error == MessageError::kNone && message.version != decltype(message)::VERSION)
    error = MessageError::kWrongVersion;
  if (error == MessageError::kNone) error = check(message);
  if (error != MessageError::kNone) return error;
  state.sequence = message.sequence;
  state.time = std::chrono::nanoseconds(message.time_ns);
  state.contact_set_age = std::chrono::nanoseconds(message.contact_set_age_ns);
  state.is_contact_set_late = (message.flags & haptic_state_t::FLAG_CONTACT_SET_LATE) != 0;
  state.part_count = message.part_count;
  state.hand_count = message.hand_count;
  state.lateness = std::chrono::nanoseconds(message.lateness_ns);
  state.last_duration = std::chrono::nanoseconds(message.last_duration_ns);
  state.contact_count = message.contact_count;
  for (std::size_t p = 0; p < kHapticParts; ++p)
    state.parts[p] = part_of(message.parts[p]);
  for (std::size_t h = 0; h < kHapticHands; ++h)
    state.hands[h] = hand_of(message.hands[h]);
  for (std::size_t c = 0; c < kHapticContacts; ++c)
    state.contacts[c] = contact_of(message.contacts[c]);
  state.patch_count = message.patch_count;
  state.patches_left_out = message.patches_left_out;
  for (std::size_t p = 0; p < kHapticPatches; ++p)
    state.patches[p] = patch_of(message.patches[p]);
  return MessageError::kNone;
}

}  // namespace glissade::devices

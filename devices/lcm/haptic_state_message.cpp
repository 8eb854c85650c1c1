#include "lcm/haptic_state_message.h"

#include <algorithm>
#include <chrono>
#include <cstddef>

#include <glissade/lcmtypes/haptic_contact_t.hpp>
#include <glissade/lcmtypes/haptic_hand_t.hpp>
#include <glissade/lcmtypes/haptic_part_t.hpp>
#include <glissade/lcmtypes/haptic_patch_t.hpp>
#include <glissade/lcmtypes/haptic_state_t.hpp>

#include "lcm/message_fields.h"

namespace glissade::devices {
namespace {

constexpr double kLargestNormal = 1.001;
constexpr std::int32_t kAllSegments = (1 << 24) - 1;

static_assert(haptic_hand_t::REASON_STOPPED == 1);
static_assert(haptic_hand_t::REASON_ENERGY == 1 << (kLimitReasons.size() - 1));

DecodeResult check(const haptic_state_t& message) noexcept {
  FieldCheck fields;
  fields.not_negative("sequence", message.sequence);
  fields.time("time_ns", message.time_ns);
  fields.time("contact_set_age_ns", message.contact_set_age_ns);
  fields.between("part_count", message.part_count, 0, static_cast<std::int32_t>(kHapticParts));
  fields.between("hand_count", message.hand_count, 0, static_cast<std::int32_t>(kHapticHands));
  fields.between("contact_count", message.contact_count, 0, static_cast<std::int32_t>(kHapticContacts));
  fields.between("patch_count", message.patch_count, 0, static_cast<std::int32_t>(kHapticPatches));
  fields.not_negative("patches_left_out", message.patches_left_out);
  fields.time("lateness_ns", message.lateness_ns);
  fields.time("last_duration_ns", message.last_duration_ns);
  for (const haptic_part_t& part : message.parts) {
    fields.magnitude("position_WG_m", part.position_WG_m, kLargestPosition);
    fields.unit_vector("orientation_WG_wxyz", part.orientation_WG_wxyz);
    fields.magnitude("position_WV_m", part.position_WV_m, kLargestPosition);
    fields.unit_vector("orientation_WV_wxyz", part.orientation_WV_wxyz);
    fields.magnitude("p_Vref_m", part.p_Vref_m, kLargestPosition);
    fields.not_negative("contact_count", part.contact_count);
  }
  for (const haptic_hand_t& hand : message.hands) {
    fields.between("part", hand.part, -1, static_cast<std::int32_t>(kHapticParts) - 1);
    fields.magnitude("force_W_N", hand.force_W_N, kLargestForce);
    fields.magnitude("torque_V_W_Nm", hand.torque_V_W_Nm, kLargestTorque);
    fields.magnitude("contact_share", hand.contact_share, 1.0);
    fields.magnitude("energy_J", hand.energy_J, kLargestEnergy);
    fields.magnitude("glove_energy_J", hand.glove_energy_J, kLargestEnergy);
    fields.between("touching", hand.touching, 0, kAllSegments);
    fields.magnitude("position_WH_m", hand.position_WH_m, kLargestPosition);
    fields.unit_vector("orientation_WH_wxyz", hand.orientation_WH_wxyz);
    fields.magnitude("joint_angles_rad", hand.joint_angles_rad, kLargestAngle);
    fields.magnitude("joint_torques_Nm", hand.joint_torques_Nm, kLargestTorque);
  }
  for (const haptic_contact_t& contact : message.contacts) {
    fields.between("part", contact.part, 0, static_cast<std::int32_t>(kHapticParts) - 1);
    fields.magnitude("position_V_m", contact.position_V_m, kLargestPosition);
    fields.magnitude("normal_W", contact.normal_W, kLargestNormal);
  }
  for (const haptic_patch_t& patch : message.patches) {
    fields.between("part", patch.part, 0, static_cast<std::int32_t>(kHapticParts) - 1);
    fields.not_negative("contact_count", patch.contact_count);
    fields.magnitude("position_V_m", patch.position_V_m, kLargestPosition);
    fields.magnitude("normal_W", patch.normal_W, kLargestNormal);
    fields.magnitude("extent_m", static_cast<double>(patch.extent_m), kLargestPosition);
  }
  return fields.result();
}

haptic_part_t message_of(const HapticPartState& part) {
  haptic_part_t message{};
  put(Eigen::Vector3d(part.X_WG.translation()), message.position_WG_m);
  put(Eigen::Matrix3d(part.X_WG.linear()), message.orientation_WG_wxyz);
  put(Eigen::Vector3d(part.X_WV.translation()), message.position_WV_m);
  put(Eigen::Matrix3d(part.X_WV.linear()), message.orientation_WV_wxyz);
  put(part.p_Vref, message.p_Vref_m);
  message.part_state = static_cast<std::int32_t>(part.state);
  message.contact_count = part.contact_count;
  return message;
}

HapticPartState part_of(const haptic_part_t& message) noexcept {
  return {.X_WG = pose_of(message.position_WG_m, message.orientation_WG_wxyz),
          .X_WV = pose_of(message.position_WV_m, message.orientation_WV_wxyz),
          .p_Vref = Eigen::Vector3d(message.p_Vref_m),
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

hands::VisibleHand visible_hand_of(const haptic_hand_t& message) noexcept {
  hands::VisibleHand visible{.activity = enumeration_of<hands::HandActivity>(message.activity, hands::kHandActivities),
                             .grasp = enumeration_of<hands::GraspType>(message.grasp, hands::kGraspTypes),
                             .form = enumeration_of<hands::GraspForm>(message.form, hands::kGraspForms),
                             .touching = message.touching,
                             .X_WH = pose_of(message.position_WH_m, message.orientation_WH_wxyz)};
  std::copy_n(message.joint_angles_rad, hands::kJoints, visible.angles.begin());
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
  std::copy_n(message.joint_torques_Nm, hands::kJoints, hand.joint_torques.begin());
  return hand;
}

}  // namespace

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

DecodeResult decode(std::span<const std::uint8_t> bytes, HapticState& state) noexcept {
  haptic_state_t message{};
  DecodeResult result = from_bytes(bytes, message);
  if (result == MessageError::kNone) result = check(message);
  if (result != MessageError::kNone) return result;
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

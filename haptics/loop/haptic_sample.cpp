#include "loop/haptic_sample.h"

#include <algorithm>

#include <glissade/contact/spring.h>

namespace glissade::haptics {

namespace {

devices::HapticPartState part_after(const GhostOfPart& ghost, const PartAnswer& answer, bool is_answered) noexcept {
  devices::HapticPartState part;
  part.X_WG = ghost.X_WG;
  part.X_WV = answer.X_WV;
  part.p_Vref = answer.p_Vref;
  if (is_answered) part.state = part_state_of(answer.state);
  part.contact_count = answer.pushing;
  return part;
}

devices::HapticHandState hand_after(const HandTick& tick, const ContactSet& set, const hands::VisibleHand& visible,
                                    const devices::GloveState& state) noexcept {
  const devices::GloveCommand& command = tick.command.values();
  const Eigen::Vector3d& p_WH = state.X_WH.translation();
  const Eigen::Vector3d p_Wabout = tick.part ? Eigen::Vector3d(set.parts[*tick.part].X_WV.translation()) : p_WH;
  const devices::HandWrench held = devices::half_space_wrench(command.half_spaces, state.X_WH);
  const contact::Wrench on_hand =
      contact::about_point({command.f_H_W + held.f_H_W, command.t_H_W + held.t_H_W}, p_WH, p_Wabout);
  devices::HapticHandState hand;
  hand.part = tick.part ? static_cast<std::int32_t>(*tick.part) : -1;
  hand.force_W = on_hand.f;
  hand.torque_V_W = on_hand.t;
  hand.contact_share = tick.contact_share;
  hand.are_contacts_unsolved = tick.is_unsolved;
  hand.reasons = tick.command.reasons();
  hand.state_age = tick.command.age();
  hand.glove_reasons = state.limits;
  hand.command_age = state.command_age;
  hand.energy = tick.command.energy();
  hand.glove_energy = state.energy;
  hand.visible = visible;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    hand.joint_torques[j] =
        command.joint_torques[j] + devices::limit_torque(command.joint_limits.joints[j], state.joint_angles[j], 0.0);
  }
  return hand;
}

/// The contacts move with the visible part.
void add_contacts(const ContactSet& set, devices::HapticState& sample) noexcept {
  for (const ContactRow& row : set.rows()) {
    if (!row.pushes) continue;
    if (static_cast<std::size_t>(sample.contact_count) == sample.contacts.size()) return;
    const auto part = static_cast<std::size_t>(row.part);
    const Eigen::Vector3d p_V = set.parts[part].p_Vref + set.parts[part].X_WV_of_rows.linear().transpose() * row.r;
    sample.contacts[static_cast<std::size_t>(sample.contact_count++)] = {row.part, p_V.cast<float>(),
                                                                         row.n.cast<float>()};
  }
}

}  // namespace

devices::HapticState make_sample(const TickRecord& record, const ContactSet& set,
                                 std::span<const devices::GloveState* const> states) noexcept {
  static_assert(contact::kMaxParts == devices::kHapticParts && hands::kMaxHands == devices::kHapticHands);
  const HapticTick& tick = record.tick;
  devices::HapticState sample;
  sample.sequence = record.sequence;
  sample.time = record.time;
  sample.contact_set_age = set.sequence == 0 ? std::chrono::nanoseconds(0) : record.time - set.time;
  sample.lateness = std::max(record.time - record.deadline, std::chrono::nanoseconds(0));
  sample.last_duration = record.last_duration;
  sample.is_contact_set_late = sample.contact_set_age > kLateContactSet;
  sample.part_count = set.part_count;
  sample.hand_count = static_cast<std::int32_t>(states.size());
  for (std::size_t p = 0; p < static_cast<std::size_t>(set.part_count); ++p)
    sample.parts[p] = part_after(tick.ghosts.parts[p], set.parts[p], set.sequence != 0);
  for (std::size_t h = 0; h < states.size(); ++h) {
    if (states[h] != nullptr) sample.hands[h] = hand_after(tick.hands[h], set, set.hands[h].visible, *states[h]);
  }
  add_contacts(set, sample);
  sample.patch_count = set.patch_count;
  sample.patches_left_out = set.patches_left_out;
  // What an older set left behind the last one does not count.
  std::copy_n(set.patches.begin(), set.patch_count, sample.patches.begin());
  return sample;
}

}  // namespace glissade::haptics

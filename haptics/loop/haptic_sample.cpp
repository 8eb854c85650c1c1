#include "loop/haptic_sample.h"

namespace glissade::haptics {

devices::PartState part_state_of(SlidingState state) noexcept {
  switch (state) {
    case SlidingState::kReleased:
      return devices::PartState::kReleased;
    case SlidingState::kFree:
      return devices::PartState::kFree;
    case SlidingState::kSliding:
      return devices::PartState::kSliding;
    case SlidingState::kResting:
      return devices::PartState::kResting;
    case SlidingState::kCatchingUp:
      return devices::PartState::kCatchingUp;
  }
  return devices::PartState::kUnknown;
}

devices::HapticState make_sample(const HapticTick& tick, const ContactSet& set, const devices::GloveState& state,
                                 std::chrono::nanoseconds now) noexcept {
  devices::HapticState sample;
  sample.sequence = tick.command.values().sequence;
  sample.time = now;
  sample.X_WG = tick.X_WG;
  sample.X_WV = set.X_WV;
  const devices::GloveCommand& command = tick.command.values();
  const Wrench on_hand = about_point({command.f_H_W, command.t_H_W}, state.X_WH.translation(), set.X_WV.translation());
  sample.force_on_hand_W = on_hand.f;
  sample.torque_on_hand_V_W = on_hand.t;
  if (set.sequence != 0) sample.part_state = part_state_of(set.state);
  sample.contact_count = set.pushing;
  sample.contact_set_age = set.sequence == 0 ? std::chrono::nanoseconds(0) : now - set.time;
  sample.is_in_contact = set.pushing > 0;
  sample.contact_share = tick.contact_share;
  sample.are_contacts_unsolved = tick.is_unsolved;
  sample.reasons = tick.command.reasons();
  sample.state_age = tick.command.age();
  sample.glove_reasons = state.limits;
  sample.command_age = state.command_age;
  sample.energy = tick.command.energy();
  sample.glove_energy = state.energy;
  sample.is_contact_set_late = sample.contact_set_age > kLateContactSet;
  return sample;
}

}  // namespace glissade::haptics

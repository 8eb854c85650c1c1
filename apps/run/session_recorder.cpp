#include <algorithm>

#include <glissade/apps/run/session_recorder.h>

namespace glissade::apps {

SessionRecorder::SessionRecorder(std::size_t capacity, std::size_t parts, std::size_t hands)
    : parts_(parts),
      hands_(hands),
      ticks_(capacity),
      part_states_(capacity * parts),
      hand_states_(capacity * hands),
      contacts_(capacity / kContactsEvery + 2) {}

void SessionRecorder::record(const devices::HapticState& sample) noexcept {
  const std::size_t slot = static_cast<std::size_t>(total_) % ticks_.size();
  ticks_[slot] = {sample.time, sample.contact_set_age, sample.lateness, sample.last_duration,
                  sample.is_contact_set_late};
  std::copy_n(sample.parts.begin(), parts_, part_states_.begin() + static_cast<std::ptrdiff_t>(slot * parts_));
  std::copy_n(sample.hands.begin(), hands_, hand_states_.begin() + static_cast<std::ptrdiff_t>(slot * hands_));
  if (total_ % kContactsEvery == 0)
    contacts_[static_cast<std::size_t>(total_ / kContactsEvery) % contacts_.size()] = {
        sample.contact_count, sample.contacts, sample.patch_count, sample.patches_left_out, sample.patches};
  ++total_;
}

std::size_t SessionRecorder::size() const {
  return std::min(static_cast<std::size_t>(total_), ticks_.size());
}

devices::HapticState SessionRecorder::state(std::size_t i) const {
  const Tick& tick = this->tick(i);
  devices::HapticState state;
  state.sequence = total_ - static_cast<std::int64_t>(size() - i) + 1;
  state.time = tick.time;
  state.contact_set_age = tick.contact_set_age;
  state.is_contact_set_late = tick.is_contact_set_late;
  state.lateness = tick.lateness;
  state.last_duration = tick.last_duration;
  state.part_count = static_cast<std::int32_t>(parts_);
  state.hand_count = static_cast<std::int32_t>(hands_);
  const Contacts& kept = contacts_[static_cast<std::size_t>((state.sequence - 1) / kContactsEvery) % contacts_.size()];
  state.contact_count = kept.count;
  state.contacts = kept.contacts;
  state.patch_count = kept.patch_count;
  state.patches_left_out = kept.patches_left_out;
  state.patches = kept.patches;
  for (std::size_t p = 0; p < parts_; ++p)
    state.parts[p] = part(i, p);
  for (std::size_t h = 0; h < hands_; ++h)
    state.hands[h] = hand(i, h);
  return state;
}

std::size_t SessionRecorder::slot(std::size_t i) const {
  return (static_cast<std::size_t>(total_) - size() + i) % ticks_.size();
}

}  // namespace glissade::apps

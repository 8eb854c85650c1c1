#include <algorithm>

#include <glissade/apps/session_recorder.h>

namespace glissade::apps {

SessionRecorder::SessionRecorder(std::size_t capacity, std::size_t parts, std::size_t hands)
    : parts_(parts), hands_(hands), ticks_(capacity), part_states_(capacity * parts), hand_states_(capacity * hands) {}

void SessionRecorder::record(const devices::HapticState& sample) noexcept {
  const std::size_t slot = static_cast<std::size_t>(total_) % ticks_.size();
  ticks_[slot] = {sample.time, sample.contact_set_age};
  std::copy_n(sample.parts.begin(), parts_, part_states_.begin() + static_cast<std::ptrdiff_t>(slot * parts_));
  std::copy_n(sample.hands.begin(), hands_, hand_states_.begin() + static_cast<std::ptrdiff_t>(slot * hands_));
  ++total_;
}

std::size_t SessionRecorder::size() const {
  return std::min(static_cast<std::size_t>(total_), ticks_.size());
}

std::size_t SessionRecorder::slot(std::size_t i) const {
  return (static_cast<std::size_t>(total_) - size() + i) % ticks_.size();
}

}  // namespace glissade::apps

#include <glissade/haptics/contact_set.h>

namespace glissade::haptics {

devices::PartState part_state_of(contact::SlidingState state) noexcept {
  switch (state) {
    case contact::SlidingState::kReleased:
      return devices::PartState::kReleased;
    case contact::SlidingState::kFree:
      return devices::PartState::kFree;
    case contact::SlidingState::kSliding:
      return devices::PartState::kSliding;
    case contact::SlidingState::kResting:
      return devices::PartState::kResting;
    case contact::SlidingState::kCatchingUp:
      return devices::PartState::kCatchingUp;
  }
  return devices::PartState::kUnknown;
}

}  // namespace glissade::haptics

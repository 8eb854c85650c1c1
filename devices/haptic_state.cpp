#include <glissade/devices/haptic_state.h>

namespace glissade::devices {

std::string_view name_of(PartState state) {
  switch (state) {
    case PartState::kUnknown:
      break;
    case PartState::kReleased:
      return "released";
    case PartState::kFree:
      return "free";
    case PartState::kSliding:
      return "sliding";
    case PartState::kResting:
      return "resting";
    case PartState::kCatchingUp:
      return "catching-up";
  }
  return "unknown";
}

PartState part_state_from_number(std::int32_t number) noexcept {
  return number >= 0 && number < kPartStates ? static_cast<PartState>(number) : PartState::kUnknown;
}

}  // namespace glissade::devices

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

std::string_view name_of(HandActivity activity) {
  switch (activity) {
    case HandActivity::kNone:
      break;
    case HandActivity::kLost:
      return "lost";
    case HandActivity::kWaiting:
      return "waiting";
    case HandActivity::kFree:
      return "free";
    case HandActivity::kHolding:
      return "holding";
  }
  return "none";
}

std::string_view name_of(GraspKind kind) {
  switch (kind) {
    case GraspKind::kNone:
      break;
    case GraspKind::kPush:
      return "push";
    case GraspKind::kPrecision:
      return "precision";
    case GraspKind::kPower:
      return "power";
  }
  return "none";
}

std::string_view name_of(GraspForm form) {
  switch (form) {
    case GraspForm::kNone:
      break;
    case GraspForm::kTipPinch:
      return "tip-pinch";
    case GraspForm::kThreeJaw:
      return "three-jaw";
    case GraspForm::kThreePoint:
      return "three-point";
    case GraspForm::kKey:
      return "key";
    case GraspForm::kCigarette:
      return "cigarette";
    case GraspForm::kGravity:
      return "gravity";
  }
  return "";
}

PartState part_state_from_number(std::int32_t number) noexcept {
  return number >= 0 && number < kPartStates ? static_cast<PartState>(number) : PartState::kUnknown;
}

}  // namespace glissade::devices

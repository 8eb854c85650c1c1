#include <glissade/hands/hand.h>

namespace glissade::hands {

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

std::string_view name_of(GraspType type) {
  switch (type) {
    case GraspType::kNone:
      break;
    case GraspType::kPush:
      return "push";
    case GraspType::kPrecision:
      return "precision";
    case GraspType::kPower:
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

}  // namespace glissade::hands

#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

std::string_view name_of(SlidingState state) {
  switch (state) {
    case SlidingState::kReleased:
      return "released";
    case SlidingState::kFree:
      return "free";
    case SlidingState::kSliding:
      return "sliding";
    case SlidingState::kResting:
      return "resting";
    case SlidingState::kCatchingUp:
      return "catching-up";
  }
  return "unknown";
}

}  // namespace glissade::haptics

#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

std::string_view name_of(ContactKind kind) {
  switch (kind) {
    case ContactKind::kVertexFace:
      return "vertex/face";
    case ContactKind::kFaceVertex:
      return "face/vertex";
    case ContactKind::kEdgeEdge:
      return "edge/edge";
    case ContactKind::kVertexEdge:
      return "vertex/edge";
    case ContactKind::kEdgeVertex:
      return "edge/vertex";
    case ContactKind::kVertexVertex:
      return "vertex/vertex";
    case ContactKind::kOverlap:
      return "overlap";
  }
  return "unknown";
}

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

}  // namespace glissade::haptics

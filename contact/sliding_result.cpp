#include <glissade/contact/sliding_result.h>

namespace glissade::contact {

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

}  // namespace glissade::contact

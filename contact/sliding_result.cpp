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

Wrench contact_wrench(const SlidingResult& result, const Eigen::Vector3d& p_Vref) {
  const Eigen::Vector3d p_Wref = result.X_WV_of_contacts * p_Vref;
  Wrench sum;
  for (const Contact& contact : result.contacts) {
    const Eigen::Vector3d f_W = contact.force * contact.n_W + contact.friction_W;
    sum.f += f_W;
    sum.t += (contact.p_W - p_Wref).cross(f_W);
  }
  return sum;
}

}  // namespace glissade::contact

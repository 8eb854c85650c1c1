#include "features/contact_motion.h"

#include <algorithm>
#include <utility>

namespace glissade::contact {

Contact carried(const Contact& contact, const Eigen::Isometry3d& part_motion_W,
                const Eigen::Isometry3d& obstacle_motion_W) {
  const Eigen::Vector3d p_W = part_motion_W * contact.p_W;
  const Eigen::Vector3d q_W = obstacle_motion_W * contact.q_W();
  const Eigen::Vector3d motion_W = p_W - contact.p_W - (q_W - contact.q_W());
  const double along = contact.n_W.dot(motion_W);
  Contact moved = contact;
  moved.gap = contact.gap + along;
  moved.range = std::max(0.0, contact.range - (motion_W - along * contact.n_W).norm());
  const bool is_vertex_of_part = contact.kind == ContactKind::kVertexFace || contact.kind == ContactKind::kVertexEdge ||
                                 contact.kind == ContactKind::kVertexVertex;
  moved.p_W = is_vertex_of_part ? p_W : Eigen::Vector3d(q_W + moved.gap * contact.n_W);
  return moved;
}

Contact mirrored(const Contact& contact, std::int32_t own_body) {
  Contact mirror = contact;
  switch (contact.kind) {
    case ContactKind::kVertexFace:
      mirror.kind = ContactKind::kFaceVertex;
      break;
    case ContactKind::kFaceVertex:
      mirror.kind = ContactKind::kVertexFace;
      break;
    case ContactKind::kVertexEdge:
      mirror.kind = ContactKind::kEdgeVertex;
      break;
    case ContactKind::kEdgeVertex:
      mirror.kind = ContactKind::kVertexEdge;
      break;
    case ContactKind::kEdgeEdge:
    case ContactKind::kVertexVertex:
    case ContactKind::kOverlap:
      break;
  }
  std::swap(mirror.part_triangle, mirror.obstacle_triangle);
  std::swap(mirror.part_feature, mirror.obstacle_feature);
  mirror.obstacle = own_body;
  mirror.n_W = -contact.n_W;
  mirror.p_W = contact.q_W();
  mirror.friction_W = -contact.friction_W;
  return mirror;
}

}  // namespace glissade::contact

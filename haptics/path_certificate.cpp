#include <cmath>

#include <glissade/haptics/path_certificate.h>

#include "placed_leaf.h"

namespace glissade::haptics {

bool PathCertificate::prove(std::span<const Displacement> displacements, std::span<const Obligation> obligations,
                            std::vector<UncertifiedPair>& failures) {
  failures.clear();
  failures_ = &failures;
  bodies_.begin_step(displacements);
  rounding_ = certain_distance();
  obstacle_ = {};
  part_ = {};
  for (const Obligation& obligation : obligations)
    prove(obligation);
  return failures.empty();
}

void PathCertificate::prove(const Obligation& obligation) {
  if (obligation.bodies != BodyPair{obstacle_.number, part_.number}) select(obligation.bodies);
  if (!moves_) return;
  if (obligation.item_O.kind == TreeItem::Kind::kTriangle) {
    prove_triangles(static_cast<std::int32_t>(obligation.item_O.number),
                    static_cast<std::int32_t>(obligation.item_P.number), obligation.n_W);
    return;
  }
  const MovingItem item_O = moving(obligation.item_O, obstacle_);
  const MovingItem item_P = moving(obligation.item_P, part_);
  if (!separates(obligation.n_W, item_O, item_P)) walk(item_O, item_P);
}

/// Makes them the ones that are proved.
void PathCertificate::select(const BodyPair& bodies) {
  obstacle_ = moving(bodies.obstacle);
  part_ = moving(bodies.part);
  moves_ = bodies_.moves(bodies.obstacle) || bodies_.moves(bodies.part);
  floor_ = surroundings_.floor(bodies.obstacle, bodies.part);
  far_ = bodies_.motion(bodies.obstacle) + bodies_.motion(bodies.part) + floor_ + rounding_;
  needed_ = floor_ + rounding_ + bodies_.curvature(bodies.obstacle, 0, MovingBodies::kMoments) +
            bodies_.curvature(bodies.part, 0, MovingBodies::kMoments);
}

PathCertificate::MovingBody PathCertificate::moving(std::int32_t body) {
  return {body,
          surroundings_.bodies()[static_cast<std::size_t>(body)].body,
          {&bodies_.pose(body, 0), &bodies_.pose(body, MovingBodies::kMoments)}};
}

PathCertificate::MovingItem PathCertificate::moving(const TreeItem& item, const MovingBody& body) {
  return {item, {*body.X_WB[0] * item.box->c, *body.X_WB[1] * item.box->c}};
}

/// Proves all that two items hold; opens the larger one where they are not proved as a whole.
void PathCertificate::walk(const MovingItem& item_O, const MovingItem& item_P) {
  if (are_apart(item_O, item_P)) return;
  const bool is_leaf_O = item_O.item.kind == TreeItem::Kind::kLeaf;
  const bool is_leaf_P = item_P.item.kind == TreeItem::Kind::kLeaf;
  if (is_leaf_O && is_leaf_P) {
    prove_leaves(item_O.item.number, item_P.item.number);
    return;
  }
  const bool opens_O = !is_leaf_O && (is_leaf_P || item_O.item.box->radius >= item_P.item.box->radius);
  const MovingBody& opened = opens_O ? obstacle_ : part_;
  const std::uint32_t node = opens_O ? item_O.item.number : item_P.item.number;
  for (int c = 0; c < opened.body->tree.nodes()[node].child_count(); ++c) {
    const MovingItem child = moving(child_of(*opened.body, node, c), opened);
    if (opens_O) {
      walk(child, item_P);
    } else {
      walk(item_O, child);
    }
  }
}

/// Whether all that two items hold is certainly the floor apart on the whole path.
bool PathCertificate::are_apart(const MovingItem& item_O, const MovingItem& item_P) const {
  const TightBox& box_O = *item_O.item.box;
  const TightBox& box_P = *item_P.item.box;
  if (box_O.radius < 0.0 || box_P.radius < 0.0) return true;
  const double together = box_O.radius + box_P.radius + far_;
  if ((item_P.c_W[0] - item_O.c_W[0]).squaredNorm() > together * together) return true;
  return separates(obstacle_.X_WB[0]->linear() * box_O.axes.col(0), item_O, item_P) ||
         separates(part_.X_WB[0]->linear() * box_P.axes.col(0), item_O, item_P);
}

/// Whether one direction, or its opposite, does so.
bool PathCertificate::separates(const Eigen::Vector3d& n_W, const MovingItem& item_O, const MovingItem& item_P) const {
  const double sign = n_W.dot(item_P.c_W[0] - item_O.c_W[0]) < 0.0 ? -1.0 : 1.0;
  const auto gap = [&](std::size_t end) {
    return sign * n_W.dot(item_P.c_W[end] - item_O.c_W[end]) -
           item_O.item.box->extent_along(obstacle_.X_WB[end]->linear().transpose() * n_W) -
           item_P.item.box->extent_along(part_.X_WB[end]->linear().transpose() * n_W);
  };
  const double gap_at_begin = gap(0);
  if (gap_at_begin > far_) return true;
  return gap_at_begin >= needed_ && gap(1) >= needed_;
}

void PathCertificate::prove_leaves(std::uint32_t leaf_O, std::uint32_t leaf_P) {
  const PlacedLeaf placed_O({obstacle_.body, *obstacle_.X_WB[0]}, leaf_O);
  const PlacedLeaf placed_P({part_.body, *part_.X_WB[0]}, leaf_P);
  for (int o = 0; o < placed_O.count; ++o) {
    for (int p = 0; p < placed_P.count; ++p) {
      if (!placed_O.may_be_near(o, placed_P, p, far_)) continue;
      prove_triangles(placed_O.triangles[static_cast<std::size_t>(o)], placed_P.triangles[static_cast<std::size_t>(p)],
                      Eigen::Vector3d::Zero());
    }
  }
}

void PathCertificate::prove_triangles(std::int32_t triangle_O, std::int32_t triangle_P, const Eigen::Vector3d& n_hint) {
  const TrianglesOfBodies pair{{obstacle_.number, part_.number}, triangle_O, triangle_P};
  Eigen::Vector3d n_start;
  if (TriangleCertificate(bodies_, pair, floor_, rounding_).prove(n_hint, n_start)) return;
  failures_->push_back({pair, n_start});
}

}  // namespace glissade::haptics

#include "certificate/path_certificate.h"

#include <cmath>

#include "certificate/leaf_in_world.h"

namespace glissade::haptics {

bool PathCertificate::prove(std::span<const geometry::Displacement> displacements,
                            std::span<const PairToCertify> to_certify, std::vector<UncertifiedPair>& failures) {
  failures.clear();
  failures_ = &failures;
  bodies_.begin_step(displacements);
  rounding_ = certain_distance();
  obstacle_ = {};
  part_ = {};
  for (const PairToCertify& pair_to_certify : to_certify)
    prove(pair_to_certify);
  return failures.empty();
}

void PathCertificate::prove(const PairToCertify& pair_to_certify) {
  if (pair_to_certify.bodies != BodyPair{obstacle_.number, part_.number}) select(pair_to_certify.bodies);
  if (!moves_) return;
  if (pair_to_certify.item_O.kind == TreeItem::Kind::kTriangle) {
    prove_triangles(static_cast<std::int32_t>(pair_to_certify.item_O.number),
                    static_cast<std::int32_t>(pair_to_certify.item_V.number), pair_to_certify.n_W);
    return;
  }
  const MovingItem item_O = moving(pair_to_certify.item_O, obstacle_);
  const MovingItem item_V = moving(pair_to_certify.item_V, part_);
  if (!separates(pair_to_certify.n_W, item_O, item_V)) walk(item_O, item_V);
}

/// Makes `bodies` the pair at hand.
void PathCertificate::select(const BodyPair& bodies) {
  obstacle_ = moving(bodies.obstacle);
  part_ = moving(bodies.part);
  moves_ = bodies_.moves(bodies.obstacle) || bodies_.moves(bodies.part);
  min_clearance_ = scene_.min_clearance(bodies.obstacle, bodies.part);
  far_ = bodies_.motion(bodies.obstacle) + bodies_.motion(bodies.part) + min_clearance_ + rounding_;
  needed_ = min_clearance_ + rounding_ + bodies_.curvature(bodies.obstacle, 0, MovingBodies::kMoments) +
            bodies_.curvature(bodies.part, 0, MovingBodies::kMoments);
}

PathCertificate::MovingBody PathCertificate::moving(std::int32_t body) {
  return {body,
          scene_.bodies()[static_cast<std::size_t>(body)].body,
          {&bodies_.pose(body, 0), &bodies_.pose(body, MovingBodies::kMoments)}};
}

PathCertificate::MovingItem PathCertificate::moving(const TreeItem& item, const MovingBody& body) {
  return {item, {*body.X_WB[0] * item.box->c, *body.X_WB[1] * item.box->c}};
}

/// Certifies the contents of two items; opens the larger item if they cannot be certified as a whole.
void PathCertificate::walk(const MovingItem& item_O, const MovingItem& item_V) {
  if (are_apart(item_O, item_V)) return;
  const bool is_leaf_O = item_O.item.kind == TreeItem::Kind::kLeaf;
  const bool is_leaf_V = item_V.item.kind == TreeItem::Kind::kLeaf;
  if (is_leaf_O && is_leaf_V) {
    prove_leaves(item_O.item.number, item_V.item.number);
    return;
  }
  const bool opens_O = !is_leaf_O && (is_leaf_V || item_O.item.box->radius >= item_V.item.box->radius);
  const MovingBody& opened = opens_O ? obstacle_ : part_;
  const std::uint32_t node = opens_O ? item_O.item.number : item_V.item.number;
  const int children = opened.body->tree.node(node).child_count();
  for (int c = 0; c < children; ++c) {
    const MovingItem child = moving(child_of(*opened.body, node, c), opened);
    if (opens_O) {
      walk(child, item_V);
    } else {
      walk(item_O, child);
    }
  }
}

/// Whether the contents of two items certainly keep the minimum clearance on the whole path.
bool PathCertificate::are_apart(const MovingItem& item_O, const MovingItem& item_V) const {
  const Obb& box_O = *item_O.item.box;
  const Obb& box_V = *item_V.item.box;
  if (box_O.radius < 0.0 || box_V.radius < 0.0) return true;
  const double together = box_O.radius + box_V.radius + far_;
  if ((item_V.c_W[0] - item_O.c_W[0]).squaredNorm() > together * together) return true;
  return separates(obstacle_.X_WB[0]->linear() * box_O.axes.col(0), item_O, item_V) ||
         separates(part_.X_WB[0]->linear() * box_V.axes.col(0), item_O, item_V);
}

/// Whether the direction n_W, or its opposite, separates the contents of two items on the whole path.
bool PathCertificate::separates(const Eigen::Vector3d& n_W, const MovingItem& item_O, const MovingItem& item_V) const {
  const double sign = n_W.dot(item_V.c_W[0] - item_O.c_W[0]) < 0.0 ? -1.0 : 1.0;
  const auto gap = [&](std::size_t end) {
    return sign * n_W.dot(item_V.c_W[end] - item_O.c_W[end]) -
           item_O.item.box->extent_along(obstacle_.X_WB[end]->linear().transpose() * n_W) -
           item_V.item.box->extent_along(part_.X_WB[end]->linear().transpose() * n_W);
  };
  const double gap_at_begin = gap(0);
  if (gap_at_begin > far_) return true;
  return gap_at_begin >= needed_ && gap(1) >= needed_;
}

void PathCertificate::prove_leaves(std::uint32_t leaf_O, std::uint32_t leaf_V) {
  const LeafInWorld placed_O({obstacle_.body, *obstacle_.X_WB[0]}, leaf_O);
  const LeafInWorld placed_V({part_.body, *part_.X_WB[0]}, leaf_V);
  for (int o = 0; o < placed_O.count; ++o) {
    for (int p = 0; p < placed_V.count; ++p) {
      if (!placed_O.may_be_near(o, placed_V, p, far_)) continue;
      prove_triangles(placed_O.triangles[static_cast<std::size_t>(o)], placed_V.triangles[static_cast<std::size_t>(p)],
                      Eigen::Vector3d::Zero());
    }
  }
}

void PathCertificate::prove_triangles(std::int32_t triangle_O, std::int32_t triangle_V, const Eigen::Vector3d& n_hint) {
  const TrianglesOfBodies pair{{obstacle_.number, part_.number}, triangle_O, triangle_V};
  Eigen::Vector3d n_start;
  if (TriangleCertificate(bodies_, pair, min_clearance_, rounding_).prove(n_hint, n_start)) return;
  failures_->push_back({pair, n_start});
}

}  // namespace glissade::haptics

#include "certificate/path_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glissade/base/assert.h>

#include "certificate/leaf_in_world.h"

namespace glissade::contact {
namespace {

// Work of the proof of a pair of boxes, of leaves, of triangles that a known direction separates or that vector code
// looks at, of other triangles, and of each stretch of a path that needs distances: in the unit of
// `collision::WorkMeter`: rough. Steps take 0.4 ns a unit.
constexpr std::int64_t kWorkOfBoxes = 60;
constexpr std::int64_t kWorkOfLeaves = 300;
constexpr std::int64_t kWorkOfLook = 60;
constexpr std::int64_t kWorkOfTriangles = 150;
constexpr std::int64_t kWorkOfStretch = 1000;

/// The place of a pair that is not itself among those to certify.
constexpr std::size_t kNoPlace = std::numeric_limits<std::size_t>::max();

/// An interval of heights along a direction, metres.
struct Heights {
  double bottom;
  double top;
};

/// The heights along n_W of a body's triangle. The direction is turned instead of the corners: there is only one.
Heights heights_of(const ContactBody& body, const Eigen::Isometry3d& X_WB, std::int32_t triangle,
                   const Eigen::Vector3d& n_W) {
  const geometry::TriangleMesh& mesh = body.tree.mesh();
  const Eigen::Vector3d n_B = X_WB.linear().transpose() * n_W;
  const double h0 = n_B.dot(mesh.corner(triangle, 0));
  const double h1 = n_B.dot(mesh.corner(triangle, 1));
  const double h2 = n_B.dot(mesh.corner(triangle, 2));
  const double origin = n_W.dot(X_WB.translation());
  return {origin + std::min({h0, h1, h2}), origin + std::max({h0, h1, h2})};
}

}  // namespace

void PathCertificate::begin_step(std::span<const geometry::Displacement> displacements) {
  bodies_.begin_step(displacements);
  keeps_directions_ = true;
  rounding_ = certain_distance();
  most_taken_.reset();
  forget_bodies();
}

std::optional<PathOfBodies> PathCertificate::path_of(const BodyPair& bodies, const BallAboutPart& ball) {
  select(bodies);
  if (!seeks_lasting_directions()) return std::nullopt;
  return PathOfBodies{.X_OV_begin = relative_pose(*obstacle_.X_WB[0], *part_.X_WB[0]),
                      .X_OV_end = relative_pose(*obstacle_.X_WB[1], *part_.X_WB[1]),
                      .needed = needed_,
                      .needed_turning = needed_turning(ball),
                      .far = far_};
}

void PathCertificate::begin(const BodiesMotion& motion, std::size_t first_mover,
                            std::span<const PairToCertify> to_certify, std::optional<double> most_taken) {
  bodies_.begin_step(motion, first_mover);
  keeps_directions_ = false;
  rounding_ = certain_distance();
  most_taken_ = most_taken;
  forget_bodies();
  begin(to_certify);
}

/// Also pairs of theirs that an exception left behind.
void PathCertificate::forget_bodies() {
  obstacle_ = {};
  part_ = {};
  separations_.clear();
}

void PathCertificate::begin(std::span<const PairToCertify> to_certify) {
  rest_ = to_certify;
  place_ = 0;
  open_.clear();
  failures_.clear();
  separated_.clear();
}

bool PathCertificate::go_on(WorkBudget& budget) {
  while (!open_.empty() || !rest_.empty()) {
    if (!open_.empty()) {
      const OpenItems items = open_.back();
      open_.pop_back();
      prove(items, budget);
    } else {
      const PairToCertify& pair_to_certify = rest_.front();
      rest_ = rest_.subspan(1);
      prove(pair_to_certify, budget);
      ++place_;
    }
    if (budget.is_used_up()) break;
  }
  prove_waiting(budget);
  return open_.empty() && rest_.empty();
}

void PathCertificate::prove(const PairToCertify& pair_to_certify, WorkBudget& budget) {
  if (pair_to_certify.bodies != BodyPair{obstacle_.number, part_.number}) {
    prove_waiting(budget);
    select(pair_to_certify.bodies);
  }
  if (!moves_) return;
  if (pair_to_certify.item_O.kind == TreeItem::Kind::kTriangle) {
    prove(Triangles{static_cast<std::int32_t>(pair_to_certify.item_O.number),
                    static_cast<std::int32_t>(pair_to_certify.item_V.number), pair_to_certify.n_W, place_},
          budget);
    return;
  }
  budget.spend(kWorkOfBoxes);
  const OpenItems items{moving(pair_to_certify.item_O, obstacle_), moving(pair_to_certify.item_V, part_)};
  if (!separates(pair_to_certify.n_W, items.item_O, items.item_V)) open_.push_back(items);
}

/// Makes `bodies` the pair at hand.
void PathCertificate::select(const BodyPair& bodies) {
  GLISSADE_ASSERT(separations_.count() == 0);
  obstacle_ = moving(bodies.obstacle);
  part_ = moving(bodies.part);
  obstacle_moves_ = bodies_.moves(bodies.obstacle);
  moves_ = obstacle_moves_ || bodies_.moves(bodies.part);
  min_clearance_ = scene_.min_clearance(bodies.obstacle, bodies.part);
  if (most_taken_)
    min_clearance_ = std::max(min_clearance_, scene_.margin(bodies.obstacle, bodies.part) - *most_taken_);
  far_ = bodies_.motion(bodies.obstacle) + bodies_.motion(bodies.part) + min_clearance_ + rounding_;
  needed_ = min_clearance_ + rounding_ + bodies_.curvature(bodies.obstacle, 0, MovingBodies::kMoments) +
            bodies_.curvature(bodies.part, 0, MovingBodies::kMoments);
  if (seeks_lasting_directions()) start_separations();
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
void PathCertificate::prove(const OpenItems& items, WorkBudget& budget) {
  const auto& [item_O, item_V] = items;
  budget.spend(kWorkOfBoxes);
  if (are_apart(item_O, item_V)) return;
  const bool is_leaf_O = item_O.item.kind == TreeItem::Kind::kLeaf;
  const bool is_leaf_V = item_V.item.kind == TreeItem::Kind::kLeaf;
  if (is_leaf_O && is_leaf_V) {
    prove_leaves(item_O.item.number, item_V.item.number, budget);
    return;
  }
  const bool opens_O = !is_leaf_O && (is_leaf_V || item_O.item.box->radius >= item_V.item.box->radius);
  const MovingBody& opened = opens_O ? obstacle_ : part_;
  const std::uint32_t node = opens_O ? item_O.item.number : item_V.item.number;
  for (int c = opened.body->tree.node(node).child_count() - 1; c >= 0; --c) {
    const MovingItem child = moving(child_of(*opened.body, node, c), opened);
    open_.push_back(opens_O ? OpenItems{child, item_V} : OpenItems{item_O, child});
  }
}

/// Whether the contents of two items certainly keep the minimum clearance on the whole path.
bool PathCertificate::are_apart(const MovingItem& item_O, const MovingItem& item_V) const {
  const collision::Obb& box_O = *item_O.item.box;
  const collision::Obb& box_V = *item_V.item.box;
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

/// Whether the direction n_W separates two triangles on the whole path, by one rounding more than `TriangleCertificate`
/// demands, so that both always agree. Most pairs of bodies that both move, and of hands, need no more.
bool PathCertificate::separates(const Eigen::Vector3d& n_W, std::int32_t triangle_O, std::int32_t triangle_V) const {
  const double enough = needed_ + rounding_;
  double top = heights_of(*obstacle_.body, *obstacle_.X_WB[0], triangle_O, n_W).top;
  if (!(heights_of(*part_.body, *part_.X_WB[0], triangle_V, n_W).bottom - top >= enough)) return false;
  if (obstacle_moves_) top = heights_of(*obstacle_.body, *obstacle_.X_WB[1], triangle_O, n_W).top;
  return heights_of(*part_.body, *part_.X_WB[1], triangle_V, n_W).bottom - top >= enough;
}

void PathCertificate::prove_leaves(std::uint32_t leaf_O, std::uint32_t leaf_V, WorkBudget& budget) {
  const LeafInWorld placed_O({obstacle_.body, *obstacle_.X_WB[0]}, leaf_O);
  const LeafInWorld placed_V({part_.body, *part_.X_WB[0]}, leaf_V);
  budget.spend(kWorkOfLeaves);
  for (int o = 0; o < placed_O.count; ++o) {
    for (int p = 0; p < placed_V.count; ++p) {
      if (!placed_O.may_be_near(o, placed_V, p, far_)) continue;
      prove(Triangles{placed_O.triangles[static_cast<std::size_t>(o)], placed_V.triangles[static_cast<std::size_t>(p)],
                      Eigen::Vector3d::Zero(), kNoPlace},
            budget);
    }
  }
}

void PathCertificate::prove(const Triangles& triangles, WorkBudget& budget) {
  if (seeks_lasting_directions()) {
    budget.spend(kWorkOfLook);
    const geometry::TrianglePoints corners_O = obstacle_.body->tree.mesh().corners(triangles.of_obstacle);
    separations_.add(corners_O, part_.body->tree.mesh().corners(triangles.of_part), ball_.holds(corners_O));
    waiting_[separations_.count() - 1] = triangles;
    if (separations_.is_full()) prove_waiting(budget);
  } else if (separates(triangles.n_hint, triangles.of_obstacle, triangles.of_part)) {
    budget.spend(kWorkOfLook);
  } else {
    certify(triangles, budget);
  }
}

void PathCertificate::start_separations() {
  const Eigen::Isometry3d X_OV_begin = relative_pose(*obstacle_.X_WB[0], *part_.X_WB[0]);
  const Eigen::Isometry3d X_OV_end = relative_pose(*obstacle_.X_WB[1], *part_.X_WB[1]);
  ball_ = BallAboutPart::at(X_OV_begin, part_.body->tree);
  needed_turning_ = needed_turning(ball_);
  separations_.start({X_OV_begin.linear(), X_OV_begin.translation()}, {X_OV_end.linear(), X_OV_end.translation()},
                     needed_ + rounding_, needed_turning_ + rounding_);
}

/// `PathOfBodies::needed_turning` of the bodies at hand. The reference point goes straight, so it is farthest from a
/// corner at an end.
double PathCertificate::needed_turning(const BallAboutPart& ball) {
  if (!bodies_.moves(part_.number)) return needed_;
  const auto farthest_at = [&](int moment) {
    const Eigen::Vector3d p_W = bodies_.reference_point_W(part_.number, moment);
    return ball.farthest_from(obstacle_.X_WB[0]->inverse(Eigen::Affine) * p_W);
  };
  const double farthest = std::max(farthest_at(0), farthest_at(MovingBodies::kMoments));
  return min_clearance_ + rounding_ + bodies_.curvature_seen_from(part_.number, farthest);
}

/// Certifies the triangles that wait for vector code.
void PathCertificate::prove_waiting(WorkBudget& budget) {
  std::size_t i = 0;
  for (const Separation& separation : separations_.find_or_turn()) {
    const Triangles& triangles = waiting_[i++];
    const double needed = separation.turns_with_part ? needed_turning_ : needed_;
    if (separation.least() >= needed + rounding_) {
      note_direction(triangles, separations_.direction(separation));
    } else if (!(separation.turning >= needed_ + rounding_)) {
      certify(triangles, budget);
    }
  }
}

void PathCertificate::certify(const Triangles& triangles, WorkBudget& budget) {
  const TrianglesOfBodies pair{{obstacle_.number, part_.number}, triangles.of_obstacle, triangles.of_part};
  TriangleCertificate certificate(bodies_, pair, min_clearance_, rounding_);
  Eigen::Vector3d n_start = Eigen::Vector3d::Zero();
  const bool is_certified = certificate.prove(triangles.n_hint, n_start);
  budget.spend(kWorkOfTriangles + kWorkOfStretch * certificate.stretches());
  if (!is_certified) failures_.push_back({pair, n_start});
  if (!n_start.isZero(0.0)) note_direction(triangles, {obstacle_.X_WB[0]->linear().transpose() * n_start, false});
}

void PathCertificate::note_direction(const Triangles& triangles, const FixedDirection& direction) {
  if (triangles.place != kNoPlace) separated_.push_back({triangles.place, direction});
}

}  // namespace glissade::contact

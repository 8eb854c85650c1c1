#include "certificate/moving_bodies.h"

#include <algorithm>
#include <limits>

#include <glissade/base/assert.h>

namespace glissade::contact {

MovingBodies::MovingBodies(const ContactScene& scene)
    : scene_(scene),
      first_mover_body_(static_cast<std::int32_t>(scene.obstacles().size())),
      paths_(scene.movers().size()) {
  for (std::size_t b = 0; b < scene.obstacles().size(); ++b) {
    const PlacedBody& placed = scene.bodies()[b];
    const collision::DopTree& tree = placed.body->tree;
    reach_of_obstacles_ =
        std::max(reach_of_obstacles_, placed.X_WB.translation().norm() + tree.center().norm() + tree.radius());
  }
}

void MovingBodies::begin(Path& path, std::size_t mover) const {
  path.known.fill(false);
  path.X_WB_at[0] = scene_.bodies()[scene_.body_of_mover(mover)].X_WB;
  path.known[0] = true;
}

void MovingBodies::begin_step(std::span<const geometry::Displacement> displacements) {
  GLISSADE_ASSERT(displacements.size() == scene_.first_rider());
  motion_ = nullptr;
  for (std::size_t m = 0; m < paths_.size(); ++m) {
    Path& path = paths_[m];
    begin(path, m);
    const std::int32_t leader = scene_.leader(first_mover_body_ + static_cast<std::int32_t>(m));
    const geometry::Displacement d =
        leader == ContactScene::kStands ? geometry::Displacement{} : displacements[static_cast<std::size_t>(leader)];
    path.displacement = d;
    path.moves = !d.is_zero();
    path.motion = 0.0;
    path.acceleration = 0.0;
    if (!path.moves) continue;
    path.p_Bref = scene_.p_Bref(m);
    const double lever = scene_.lever(m);
    path.motion = geometry::motion_bound(d, lever);
    path.acceleration = d.w.squaredNorm() * lever;
  }
}

void MovingBodies::begin_step(const BodiesMotion& motion, std::size_t first_mover) {
  GLISSADE_ASSERT(first_mover <= paths_.size());
  motion_ = &motion;
  first_mover_ = first_mover;
  X_WM_.resize(paths_.size() - first_mover);
  for (std::size_t m = 0; m < paths_.size(); ++m) {
    Path& path = paths_[m];
    begin(path, m);
    path.displacement = {};
    path.moves = m >= first_mover;
    path.motion = path.moves ? motion.length(m - first_mover) : 0.0;
    path.acceleration = path.moves ? motion.acceleration(m - first_mover) : 0.0;
  }
}

/// Computes the poses of all movers that follow the motion.
void MovingBodies::follow_motion(std::size_t moment) {
  motion_->poses(static_cast<double>(moment) / kMoments, X_WM_);
  for (std::size_t m = first_mover_; m < paths_.size(); ++m) {
    paths_[m].X_WB_at[moment] = X_WM_[m - first_mover_];
    paths_[m].known[moment] = true;
  }
}

double MovingBodies::curvature(std::int32_t body, int begin, int end) const {
  if (!is_mover(body)) return 0.0;
  const double share = static_cast<double>(end - begin) / kMoments;
  return share * share * path(body).acceleration / 8.0;
}

/// In the frame of a body that moves on at v and turns at w, a point at u from its reference point has the acceleration
/// w × (w × u) + 2 w × v.
double MovingBodies::curvature_seen_from(std::int32_t body, double farthest) const {
  GLISSADE_ASSERT(motion_ == nullptr);
  const geometry::Displacement& d = path(body).displacement;
  return (d.w.squaredNorm() * farthest + 2.0 * d.w.norm() * d.v.norm()) / 8.0;
}

double MovingBodies::most_curvature() const {
  double most = 0.0;
  for (const Path& path : paths_)
    most = std::max(most, path.acceleration / 8.0);
  return 2.0 * most;
}

const Eigen::Isometry3d& MovingBodies::pose(std::int32_t body, int moment) {
  if (!is_mover(body)) return scene_.bodies()[static_cast<std::size_t>(body)].X_WB;
  Path& moving = path(body);
  if (!moving.moves) return moving.X_WB_at[0];
  const auto m = static_cast<std::size_t>(moment);
  if (!moving.known[m] && motion_ != nullptr) follow_motion(m);
  if (!moving.known[m]) {
    const double t = static_cast<double>(moment) / kMoments;
    moving.X_WB_at[m] = geometry::displaced(moving.X_WB_at[0], moving.p_Bref, moving.displacement.scaled(t));
    moving.known[m] = true;
  }
  return moving.X_WB_at[m];
}

geometry::TrianglePoints MovingBodies::triangle_W(std::int32_t body, std::int32_t triangle, int moment) {
  return PlacedBody{scene_.bodies()[static_cast<std::size_t>(body)].body, pose(body, moment)}.triangle_W(triangle);
}

double MovingBodies::certain_distance() const {
  double reach = reach_of_obstacles_;
  for (std::size_t m = 0; m < paths_.size(); ++m) {
    const SlidingPart& mover = *scene_.movers()[m];
    const Eigen::Isometry3d& X_WB = scene_.bodies()[scene_.body_of_mover(m)].X_WB;
    reach = std::max(reach, X_WB.translation().norm() + mover.p_Vref().norm() + mover.radius());
  }
  return 128.0 * std::numeric_limits<double>::epsilon() * reach;
}

}  // namespace glissade::contact

#include "certificate/moving_bodies.h"

#include <algorithm>
#include <limits>

#include <glissade/base/assert.h>

namespace glissade::haptics {

MovingBodies::MovingBodies(const ContactScene& scene)
    : scene_(scene), first_part_(static_cast<std::int32_t>(scene.obstacles().size())) {
  for (std::size_t b = 0; b < scene.bodies().size(); ++b) {
    const PlacedBody& placed = scene.bodies()[b];
    const collision::DopTree& tree = placed.body->tree;
    if (b < scene.obstacles().size()) {
      reach_of_obstacles_ =
          std::max(reach_of_obstacles_, placed.X_WB.translation().norm() + tree.center().norm() + tree.radius());
    } else {
      const SlidingPart& part = *scene.parts()[b - scene.obstacles().size()];
      paths_.push_back({part.p_Vref(), part.radius(), {}, false, 0.0, 0.0, {}, {}});
    }
  }
}

void MovingBodies::begin_step(std::span<const geometry::Displacement> displacements) {
  GLISSADE_ASSERT(displacements.size() == paths_.size());
  motion_ = nullptr;
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    Path& path = paths_[p];
    path.displacement = displacements[p];
    path.moves = !displacements[p].is_zero();
    path.motion = geometry::motion_bound(displacements[p], path.radius);
    path.acceleration = displacements[p].w.squaredNorm() * path.radius;
    path.known.fill(false);
    path.X_WV_at[0] = scene_.bodies()[scene_.body_of_part(p)].X_WB;
    path.known[0] = true;
  }
}

void MovingBodies::begin_step(const BodiesMotion& motion, std::size_t first_mover) {
  GLISSADE_ASSERT(first_mover <= paths_.size());
  motion_ = &motion;
  first_mover_ = first_mover;
  X_WM_.resize(paths_.size() - first_mover);
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    Path& path = paths_[p];
    path.displacement = {};
    path.moves = p >= first_mover;
    path.motion = path.moves ? motion.length(p - first_mover) : 0.0;
    path.acceleration = path.moves ? motion.acceleration(p - first_mover) : 0.0;
    path.known.fill(false);
    path.X_WV_at[0] = scene_.bodies()[scene_.body_of_part(p)].X_WB;
    path.known[0] = true;
  }
}

/// Computes the poses of all parts that follow the motion.
void MovingBodies::follow_motion(std::size_t moment) {
  motion_->poses(static_cast<double>(moment) / kMoments, X_WM_);
  for (std::size_t p = first_mover_; p < paths_.size(); ++p) {
    paths_[p].X_WV_at[moment] = X_WM_[p - first_mover_];
    paths_[p].known[moment] = true;
  }
}

double MovingBodies::curvature(std::int32_t body, int begin, int end) const {
  if (!is_part(body)) return 0.0;
  const double share = static_cast<double>(end - begin) / kMoments;
  return share * share * path(body).acceleration / 8.0;
}

const Eigen::Isometry3d& MovingBodies::pose(std::int32_t body, int moment) {
  if (!is_part(body)) return scene_.bodies()[static_cast<std::size_t>(body)].X_WB;
  Path& moving = path(body);
  const auto m = static_cast<std::size_t>(moment);
  if (!moving.known[m] && motion_ != nullptr && moving.moves) follow_motion(m);
  if (!moving.known[m]) {
    const double t = static_cast<double>(moment) / kMoments;
    moving.X_WV_at[m] = geometry::displaced(moving.X_WV_at[0], moving.p_Vref, moving.displacement.scaled(t));
    moving.known[m] = true;
  }
  return moving.X_WV_at[m];
}

geometry::TrianglePoints MovingBodies::triangle_W(std::int32_t body, std::int32_t triangle, int moment) {
  return PlacedBody{scene_.bodies()[static_cast<std::size_t>(body)].body, pose(body, moment)}.triangle_W(triangle);
}

double MovingBodies::certain_distance() const {
  double reach = reach_of_obstacles_;
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    const Eigen::Isometry3d& X_WV = scene_.bodies()[scene_.body_of_part(p)].X_WB;
    reach = std::max(reach, X_WV.translation().norm() + paths_[p].p_Vref.norm() + paths_[p].radius);
  }
  return 128.0 * std::numeric_limits<double>::epsilon() * reach;
}

}  // namespace glissade::haptics

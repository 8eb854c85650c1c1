#include "paper/collision_object.h"

#include <stdexcept>

#include <glissade/geometry/displacement.h>

namespace glissade::reference {

CollisionObject::CollisionObject(std::vector<contact::Obstacle> obstacles,
                                 std::shared_ptr<const contact::SlidingPart> part_C)
    : obstacles_(std::move(obstacles)), part_C_(std::move(part_C)) {
  if (obstacles_.empty()) throw std::invalid_argument("there is nothing that the part could touch");
  if (part_C_ == nullptr) throw std::invalid_argument("the part needs a body, not a null pointer");
  for (contact::Obstacle& obstacle : obstacles_) {
    if (obstacle.body == nullptr) throw std::invalid_argument(obstacle.name + " needs a body, not a null pointer");
    const std::optional<Eigen::Isometry3d> X_WO = geometry::rigid_pose(obstacle.X_WO);
    if (!X_WO) throw std::invalid_argument("the pose of " + obstacle.name + " is not a rotation and translation");
    obstacle.X_WO = *X_WO;
  }
}

Eigen::Isometry3d CollisionObject::pose_in_obstacle(std::size_t obstacle, const Eigen::Isometry3d& X_WC) const {
  return obstacles_[obstacle].X_WO.inverse(Eigen::Isometry) * X_WC;
}

int CollisionObject::obstacle_hit_at(const Eigen::Isometry3d& X_WC) {
  ++queries_;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    if (collision::intersects(obstacles_[i].body->tree, part_C_->tree, pose_in_obstacle(i, X_WC), workspace_)) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

void CollisionObject::touching_pairs(const Eigen::Isometry3d& X_WC, std::vector<TouchingPair>& pairs) {
  ++queries_;
  pairs.clear();
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    collision::intersecting_pairs(obstacles_[i].body->tree, part_C_->tree, pose_in_obstacle(i, X_WC), workspace_,
                                  triangles_);
    for (const collision::TrianglePair& pair : triangles_)
      pairs.push_back({static_cast<std::int32_t>(i), pair.triangle_A, pair.triangle_B});
  }
}

}  // namespace glissade::reference

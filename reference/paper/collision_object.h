#pragma once

/// The founding paper's collision object (§3.1): an invisible copy of the part that may be placed anywhere, to check
/// for collisions there.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/contact_body.h>

namespace glissade::reference {

/// Two triangles that touch: p of the part and q of an obstacle.
struct TouchingPair {
  std::int32_t obstacle;           ///< number among the obstacles
  std::int32_t obstacle_triangle;  ///< q
  std::int32_t part_triangle;      ///< p

  auto operator<=>(const TouchingPair&) const = default;
};

/// Static, exact checks (`dop_query.h`) of the part against each obstacle. Deterministic. Not thread-safe.
class CollisionObject {
 public:
  /// Throws std::invalid_argument when there is no obstacle, for null pointers, and for an obstacle whose pose
  /// `geometry::rigid_pose` rejects.
  CollisionObject(std::vector<contact::Obstacle> obstacles, std::shared_ptr<const contact::SlidingPart> part_C);

  std::span<const contact::Obstacle> obstacles() const { return obstacles_; }
  const contact::SlidingPart& part() const { return *part_C_; }

  /// The number of an obstacle that the part at X_WC touches; −1 if it touches none.
  int obstacle_hit_at(const Eigen::Isometry3d& X_WC);
  bool collides(const Eigen::Isometry3d& X_WC) { return obstacle_hit_at(X_WC) >= 0; }

  /// Replaces `pairs` by all triangles of the part at X_WC and of obstacles that touch, in ascending order.
  void touching_pairs(const Eigen::Isometry3d& X_WC, std::vector<TouchingPair>& pairs);

  /// Number of checks since construction.
  std::int64_t queries() const { return queries_; }

 private:
  Eigen::Isometry3d pose_in_obstacle(std::size_t obstacle, const Eigen::Isometry3d& X_WC) const;

  std::vector<contact::Obstacle> obstacles_;
  std::shared_ptr<const contact::SlidingPart> part_C_;
  // Not a coherent workspace: the poses of a bisection jump too far for it to help.
  collision::QueryWorkspace workspace_;
  std::vector<collision::TrianglePair> triangles_;
  std::int64_t queries_ = 0;
};

}  // namespace glissade::reference

#pragma once

/// What the part can touch: the obstacles, in a collision pipeline together with the part, which tells what is near it.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/collision/triangle_intersection.h>
#include <glissade/haptics/contact_body.h>

namespace glissade::haptics {

/// A body that stands still. Several may share one mesh.
struct Obstacle {
  std::shared_ptr<const ContactBody> body;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  std::string name = "an obstacle";  ///< for messages

  /// One of its triangles in world coordinates.
  collision::TrianglePoints triangle_W(std::int32_t triangle) const {
    const collision::TriangleMesh& mesh = body->tree.mesh();
    return {X_WO * mesh.corner(triangle, 0), X_WO * mesh.corner(triangle, 1), X_WO * mesh.corner(triangle, 2)};
  }
};

/// Obstacles are of no interest to each other: what an assembly is made of touches. Not thread-safe.
class Surroundings {
 public:
  /// `look_around` may look `greatest_reach` (metres) far. Throws std::invalid_argument as `World::add` does, and when
  /// there is no obstacle.
  Surroundings(std::vector<Obstacle> obstacles, const std::shared_ptr<const SlidingPart>& part_V,
               double greatest_reach);

  std::span<const Obstacle> obstacles() const { return obstacles_; }

  /// All pairs of triangles of an obstacle and of the part at X_WV that are not further apart than `reach` (metres).
  /// Object A of each pair of objects is the obstacle whose number is its index, B is the part; points are in the frame
  /// of the obstacle. Overwritten by the next call.
  /// Throws std::invalid_argument for a pose that `World::move` refuses.
  const collision::FrameResult& look_around(const Eigen::Isometry3d& X_WV, double reach);

  /// How often that was asked for, and the sum of the accounts of it.
  std::int64_t frames() const { return frames_; }
  const collision::FrameReport& sum_of_reports() const { return sum_; }

 private:
  std::vector<Obstacle> obstacles_;
  realtime::SteadyClock clock_;
  collision::World world_;
  collision::ObjectId part_;
  collision::CollisionPipeline pipeline_;
  std::int64_t frames_ = 0;
  collision::FrameReport sum_;
};

}  // namespace glissade::haptics

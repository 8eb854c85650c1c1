#pragma once

/// What can touch: the obstacles and the parts in the hands, where they are, and how near they may come.

#include <algorithm>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_pair.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/sliding_rules.h>

namespace glissade::haptics {

/// Metres. Of points nearer than that the direction from one to the other is not sharp enough for large triangles.
inline constexpr double kSharpDistance_m = 1e-6;

/// A body where it is now.
struct PlacedBody {
  const ContactBody* body;
  Eigen::Isometry3d X_WB;

  /// One of its triangles in world coordinates.
  geometry::TrianglePoints triangle_W(std::int32_t triangle) const {
    const geometry::TriangleMesh& mesh = body->tree.mesh();
    return {X_WB * mesh.corner(triangle, 0), X_WB * mesh.corner(triangle, 1), X_WB * mesh.corner(triangle, 2)};
  }
};

/// An obstacle where it is.
inline PlacedBody placed(const Obstacle& obstacle) {
  return {obstacle.body.get(), obstacle.X_WO};
}

/// Two bodies by their numbers, of which the second is a part; the obstacle may be another part of lower number.
struct BodyPair {
  std::int32_t obstacle;
  std::int32_t part;

  auto operator<=>(const BodyPair&) const = default;
};

/// A triangle of each of two bodies.
struct TrianglesOfBodies {
  BodyPair bodies;
  std::int32_t obstacle_triangle;
  std::int32_t part_triangle;

  auto operator<=>(const TrianglesOfBodies&) const = default;
};

/// Bodies are numbered: the obstacles first, then the parts. Obstacles are of no interest to each other: what an
/// assembly is made of touches. Not thread-safe.
class ContactScene {
 public:
  /// All parts are at the identity pose until they are placed. `margins` (metres) has one for each part. Throws
  /// std::invalid_argument when there is nothing that a part could touch, for a pose that is none, and for a margin
  /// that is not positive or above kGreatestMargin_m.
  ContactScene(std::vector<Obstacle> obstacles, std::vector<std::shared_ptr<const SlidingPart>> parts,
               std::span<const double> margins);

  std::span<const Obstacle> obstacles() const { return obstacles_; }
  std::span<const std::shared_ptr<const SlidingPart>> parts() const { return parts_; }
  std::span<const PlacedBody> bodies() const { return bodies_; }
  /// The number among the bodies of a part.
  std::size_t body_of_part(std::size_t part) const { return obstacles_.size() + part; }

  /// Metres at which contacts of two bodies, one of them a part, hold them apart: the obstacle's margin, if it has one,
  /// or else that of the part; between two parts the smaller of both.
  double margin(std::int32_t obstacle, std::int32_t part_body) const {
    const auto part = static_cast<std::size_t>(part_body) - obstacles_.size();
    return margins_[part * bodies_.size() + static_cast<std::size_t>(obstacle)];
  }

  /// Metres that every certified path of a part keeps away from a body: kMinClearanceOfMargin of the margin; less where
  /// they were nearer at the start, see `start_near`.
  double min_clearance(std::int32_t obstacle, std::int32_t part_body) const {
    const auto part = static_cast<std::size_t>(part_body) - obstacles_.size();
    return min_clearances_[part * bodies_.size() + static_cast<std::size_t>(obstacle)];
  }
  /// Two bodies are `distance` (metres) apart: their floor is 0.95 of that as long as the margin asks for no less.
  void start_near(std::int32_t obstacle, std::int32_t part_body, double distance) {
    const auto part = static_cast<std::size_t>(part_body) - obstacles_.size();
    min_clearances_[part * bodies_.size() + static_cast<std::size_t>(obstacle)] =
        std::min(kMinClearanceOfMargin * margin(obstacle, part_body), 0.95 * distance);
  }

  /// A part is at X_WV from now on, which must be a rigid pose.
  void place(std::size_t part, const Eigen::Isometry3d& X_WV) { bodies_[body_of_part(part)].X_WB = X_WV; }

 private:
  std::vector<Obstacle> obstacles_;
  std::vector<std::shared_ptr<const SlidingPart>> parts_;
  std::vector<PlacedBody> bodies_;
  std::vector<double> margins_;         // for each part one with each body
  std::vector<double> min_clearances_;  // the same
};

}  // namespace glissade::haptics

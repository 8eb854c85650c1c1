#pragma once

/// The contact scene: obstacles, parts and riders, their poses, margins and minimum clearances.

#include <algorithm>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/assert.h>
#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::contact {

/// Below this distance (metres) the closest-point direction is too ill-conditioned to separate large triangles.
inline constexpr double kSharpDistance_m = 1e-6;

/// A body and its pose.
struct PlacedBody {
  const ContactBody* body;
  Eigen::Isometry3d X_WB;

  /// A triangle of the body in world coordinates.
  geometry::TrianglePoints triangle_W(std::int32_t triangle) const {
    const geometry::TriangleMesh& mesh = body->tree.mesh();
    return {X_WB * mesh.corner(triangle, 0), X_WB * mesh.corner(triangle, 1), X_WB * mesh.corner(triangle, 2)};
  }
};

/// An obstacle as a body at its pose.
inline PlacedBody placed(const Obstacle& obstacle) {
  return {obstacle.body.get(), obstacle.X_WO};
}

/// Two bodies by their numbers. `part` is a mover; `obstacle` is an obstacle, or a mover of lower number.
struct BodyPair {
  std::int32_t obstacle;
  std::int32_t part;

  auto operator<=>(const BodyPair&) const = default;
};

/// One triangle of each of two bodies, by their numbers in the meshes.
struct TrianglesOfBodies {
  BodyPair bodies;
  std::int32_t obstacle_triangle;
  std::int32_t part_triangle;

  auto operator<=>(const TrianglesOfBodies&) const = default;
};

/// Bodies are numbered: the obstacles first, then the parts, then the riders. Parts and riders together are the movers.
/// Not every pair of bodies is considered: see `can_touch`. Not thread-safe.
class ContactScene {
 public:
  /// Groups of bodies. Bodies that stand still touch each other as pieces of an assembly do, and neighboring links of a
  /// chain touch at their joint: such pairs are not considered. Nothing stops two chains, so all of
  /// them are one group.
  static constexpr int kStill = 0;
  static constexpr int kPart = 1;
  static constexpr int kChain = 2;

  /// All parts are at the identity pose until they are placed. `margins` (metres) has one entry for each part. Throws
  /// std::invalid_argument when there is nothing that a part could touch, for an obstacle without a body, for a pose
  /// that `geometry::rigid_pose` rejects, and for a margin that is not positive or above kGreatestMargin_m.
  ContactScene(std::vector<Obstacle> obstacles, std::vector<std::shared_ptr<const SlidingPart>> parts,
               std::span<const double> margins);
  /// The same with riders, which are the movers from the number `first_rider` on, and with a margin and a group for
  /// each mover.
  ContactScene(std::vector<Obstacle> obstacles, std::vector<std::shared_ptr<const SlidingPart>> movers,
               std::size_t first_rider, std::span<const double> margins, std::span<const int> groups);

  std::span<const Obstacle> obstacles() const { return obstacles_; }
  std::span<const std::shared_ptr<const SlidingPart>> movers() const { return movers_; }
  std::span<const PlacedBody> bodies() const { return bodies_; }
  /// The body number of a mover; the movers begin with the parts.
  std::size_t body_of_mover(std::size_t mover) const { return obstacles_.size() + mover; }
  std::size_t first_rider() const { return first_rider_; }
  bool is_rider(std::int32_t body) const { return rider(body) >= 0; }
  /// The number of a rider among the riders; −1 for another body.
  std::int32_t rider(std::int32_t body) const {
    return std::max(-1, body - static_cast<std::int32_t>(body_of_mover(first_rider_)));
  }

  /// The part with which a body moves: a part moves with itself, a rider with the part to which it is attached.
  /// kStands: with none.
  static constexpr std::int32_t kStands = -1;
  std::int32_t leader(std::int32_t body) const { return leaders_[static_cast<std::size_t>(body)]; }
  void set_leader(std::int32_t rider_body, std::int32_t part) {
    GLISSADE_ASSERT(is_rider(rider_body));
    leaders_[static_cast<std::size_t>(rider_body)] = part;
  }
  /// A number that is equal for bodies between which no pair matters as long as their leaders stay: bodies that move
  /// together, that stand still together, or that belong to chains.
  std::int32_t unit(std::int32_t body) const {
    const bool moves_with_part =
        is_rider(body) ? leader(body) != kStands : group(static_cast<std::size_t>(body)) == kPart;
    return moves_with_part ? -1 - leader(body) : group(static_cast<std::size_t>(body));
  }

  int group(std::size_t body) const { return groups_[body]; }
  /// Whether pairs of these groups are considered.
  static bool can_touch(int group, int other) { return group != other || group == kPart; }

  /// Margin (metres) of contacts between a body and a mover: the obstacle's own margin if it has one, otherwise the
  /// mover's; between two parts, the smaller of both; between a rider and another mover, the greater of both, so that
  /// the rider's owner finds the clearance that it demands itself.
  double margin(std::int32_t obstacle, std::int32_t part_body) const {
    return margins_[pair_index(obstacle, part_body)];
  }

  /// Minimum clearance (metres) of every certified path between a body and a part: kMinClearanceOfMargin of the margin,
  /// or less if both started nearer, see `start_near`.
  double min_clearance(std::int32_t obstacle, std::int32_t part_body) const {
    return min_clearances_[pair_index(obstacle, part_body)];
  }
  /// Sets the minimum clearance of two bodies that are `distance` (metres) apart to 0.95 of that distance, but to no
  /// more than kMinClearanceOfMargin of the margin.
  void start_near(std::int32_t obstacle, std::int32_t part_body, double distance) {
    min_clearances_[pair_index(obstacle, part_body)] =
        std::min(kMinClearanceOfMargin * margin(obstacle, part_body), 0.95 * distance);
  }

  /// Sets it to another one.
  void set_min_clearance(std::int32_t obstacle, std::int32_t part_body, double clearance) {
    min_clearances_[pair_index(obstacle, part_body)] = clearance;
  }

  /// The reference point of a part: at first `SlidingPart::p_Vref`.
  const Eigen::Vector3d& p_Vref(std::size_t part) const { return p_Vref_[part]; }
  void set_p_Vref(std::size_t part, const Eigen::Vector3d& p_Vref) {
    GLISSADE_ASSERT(part < first_rider_);
    p_Vref_[part] = p_Vref;
  }
  /// The reference point of the part with which a mover moves, in the mover's own frame B; that of the mover itself if
  /// it stands.
  Eigen::Vector3d p_Bref(std::size_t mover) const;
  /// Bound (metres) of the distance of the mover's points from there.
  double lever(std::size_t mover) const;

  /// Places a mover at X_WB, a rigid pose; after any other pose the next search for candidates throws.
  void place(std::size_t mover, const Eigen::Isometry3d& X_WB) {
    GLISSADE_ASSERT(mover < movers_.size());
    bodies_[body_of_mover(mover)].X_WB = X_WB;
  }

 private:
  std::size_t pair_index(std::int32_t obstacle, std::int32_t part_body) const {
    const auto mover = static_cast<std::size_t>(part_body) - obstacles_.size();
    GLISSADE_ASSERT(mover < movers_.size() && static_cast<std::size_t>(obstacle) < bodies_.size());
    return mover * bodies_.size() + static_cast<std::size_t>(obstacle);
  }

  std::vector<Obstacle> obstacles_;
  std::vector<std::shared_ptr<const SlidingPart>> movers_;
  std::size_t first_rider_;
  std::vector<Eigen::Vector3d> p_Vref_;  // of each part
  std::vector<PlacedBody> bodies_;
  std::vector<int> groups_;             // of each body
  std::vector<std::int32_t> leaders_;   // of each body
  std::vector<double> margins_;         // for each mover, one entry for each body
  std::vector<double> min_clearances_;  // likewise
};

}  // namespace glissade::contact

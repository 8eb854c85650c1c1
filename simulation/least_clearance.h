#pragma once

/// The least distance of a run: the smallest distance, over all its poses, between a part and the other bodies of its
/// scene. Successive poses share work: a search is made only if the part may have come nearer than the least distance
/// so far.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/collision/query_types.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/simulation/simulation.h>

namespace glissade::simulation {

/// The work of a `LeastClearance`.
struct ClearanceWork {
  std::int64_t searches = 0;            ///< searches of two whole trees
  std::int64_t listed = 0;              ///< pairs of triangles that the searches listed
  std::int64_t directions = 0;          ///< pairs of triangles tested along the direction that separated them before
  std::int64_t triangle_distances = 0;  ///< pairs of triangles whose distance was computed
};

/// Not thread-safe. The distance is that of the features (`geometry::MeshTopology`) of the meshes, so a vertex inside a
/// flat face or a straight rim (inside up to rounding) is not measured separately.
///
/// For each body, the object keeps the pairs of triangles that the last search found near the part. A sum adds up the
/// motion bounds of the part relative to the body. If a pair was d metres apart in the search, it is still apart by at
/// least d minus the growth of this sum since then. The same holds for the pairs that the search left out, with the
/// search distance as d.
class GLISSADE_EXPORT LeastClearance {
 public:
  /// Limit of the measured clearances, in radii of the part. At greater distances, almost all pairs of triangles are
  /// about as near as the nearest, so a search would take long.
  static constexpr double kFarthest = 10.0;

  /// For the part with the number `part`. `bodies` must outlive this object. Hands do not count. Throws
  /// std::out_of_range if there is no such part.
  explicit LeastClearance(const SceneBodies& bodies, std::size_t part = 0);

  /// Adds the next pose of the part. `moving_X_WB` has the poses of the other parts, and then of the objects that move
  /// on their own, in their order in the scene. `contacts` are contacts of the part at this pose or near it. They save
  /// work, because their triangles are near. Throws std::invalid_argument if `moving_X_WB` has the wrong number of
  /// poses. Most of the cost is for pairs of triangles that come as near as the least distance so far.
  void note(const Eigen::Isometry3d& X_WV, std::span<const Eigen::Isometry3d> moving_X_WB,
            std::span<const contact::Contact> contacts);
  /// Adds the present poses of a simulation of these bodies.
  void note(const Simulation& simulation);

  /// Call this function after the last pose, before you read the results.
  void finish();

  /// Metres, up to rounding. Infinite if nothing was nearer than ten times the radius of the part.
  double least() const { return least_ < farthest() ? least_ : std::numeric_limits<double>::infinity(); }
  /// Number (from 0) of a pose with the least distance.
  std::int64_t least_at() const { return least_at_; }

  const ClearanceWork& work() const { return work_; }

 private:
  /// A pair of triangles that came near the part. The plane n_B · x = `offset` has the triangle of the body behind it.
  struct Pair {
    collision::TrianglePair triangles;  ///< of the body and the part
    Eigen::Vector3d n_B;                ///< unit, from the body to the part; zero if no direction is known
    double offset;                      ///< metres
  };
  struct Body {
    const contact::ContactBody* body_B;
    const contact::SlidingPart* moving_B;  ///< the same if it moves, or else null
    Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d X_BV = Eigen::Isometry3d::Identity();
    collision::CoherentWorkspace workspace{};
    double clock = 0.0;      ///< metres
    double step = 0.0;       ///< metres: how far the clock went on for the present pose
    double searched = 0.0;   ///< clock at the last search
    double distance = -1.0;  ///< metres: the last search listed all nearer pairs
    double meets_at = -1.0;  ///< no triangle touches the part before this clock
    std::vector<Pair> pairs{};
    std::vector<double> pair_meets_at{};  ///< the same for each pair
  };

  double farthest() const { return kFarthest * part_V_.radius(); }
  void try_contacts(const Eigen::Isometry3d& X_WV, std::span<const Eigen::Isometry3d> moving_X_WB,
                    std::span<const contact::Contact> contacts);
  void look_at_noted();
  void move_to(const Eigen::Isometry3d& X_WV, std::span<const Eigen::Isometry3d> moving_X_WB);
  void look_at(Body& body);
  void search(Body& body);
  void find_close(Body& body);
  void look_at_pairs(Body& body);
  double gap_along(const Body& body, const Pair& pair);
  double distance_of(const Body& body, const Eigen::Isometry3d& X_BV, Pair& pair);
  void take(double distance, std::int64_t pose);

  std::size_t part_;
  const contact::SlidingPart& part_V_;
  std::vector<Body> bodies_;  // obstacles, then other parts, then objects that move on their own
  std::size_t first_moving_;
  std::size_t own_number_;  // among the bodies of contacts
  std::vector<Eigen::Isometry3d> X_WV_noted_;
  std::vector<Eigen::Isometry3d> X_WB_noted_;  // those of one pose after those of another
  Eigen::Isometry3d X_WV_ = Eigen::Isometry3d::Identity();
  std::int64_t looked_at_ = 0;  // poses
  double least_;                // metres; what is no nearer does not matter
  std::int64_t least_at_ = 0;
  std::vector<collision::ClosePair> close_;
  ClearanceWork work_;
};

}  // namespace glissade::simulation

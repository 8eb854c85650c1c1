#pragma once

/// Exact polygon-soup queries between two DOP-trees: do they touch, where, and what is near.
///
/// Each takes the pose X_AB of tree B in the frame of tree A. Exact means: the answer is that of real arithmetic for
/// the vertices of A and the vertices of B after X_AB has been applied to them in double precision. Touching counts as
/// intersecting. Only triangles of positive area take part.

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

/// Triangle indices into the meshes of tree A and tree B.
struct TrianglePair {
  std::int32_t triangle_A;
  std::int32_t triangle_B;

  auto operator<=>(const TrianglePair&) const = default;
};

/// Two triangles and the points where they are closest, in the frame of A. Distance 0 when they intersect; the two
/// points are then one point of the intersection as well as rounding allows.
struct ClosePair {
  TrianglePair triangles;
  double distance;
  Eigen::Vector3d p_A;  ///< on triangle A
  Eigen::Vector3d p_B;  ///< on triangle B
};

/// Scratch memory and counters of the queries. Keep one per thread and reuse it: after a few queries nothing is
/// allocated. Not thread-safe.
class QueryWorkspace {
 public:
  /// Work of the last query.
  struct Counters {
    std::int64_t node_tests = 0;
    std::int64_t realignments = 0;
    std::int64_t triangle_tests = 0;
  };
  const Counters& counters() const { return counters_; }

 private:
  friend class DopTraversal;
  struct NodePair {
    std::int32_t node_A;
    std::int32_t node_B;
  };
  std::vector<NodePair> stack_;
  Counters counters_;
};

/// Whether any two triangles intersect. (paper §2.1)
bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace);

/// Replaces `pairs` by every intersecting pair of triangles, in ascending order.
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs);

/// Replaces `pairs` by every pair of triangles not further apart than `distance` (metres, ≥ 0), in ascending order of
/// the triangle indices, with their closest points.
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  QueryWorkspace& workspace, std::vector<ClosePair>& pairs);

}  // namespace glissade::collision

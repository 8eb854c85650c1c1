#pragma once

/// Exact polygon-soup queries between two DOP-trees: do they touch, where, and what is near.
///
/// Each takes the pose X_AB of tree B in the frame of tree A. Exact means: the answer is that of real arithmetic for
/// the vertices of A and the vertices of B after X_AB has been applied to them in double precision. Touching counts as
/// intersecting. Only triangles of positive area take part. Each throws std::invalid_argument for trees that were built
/// with different options, for a distance that is negative or not a number, and for a pose that is not finite or whose
/// matrix is not a rotation: the entries of RᵀR − 1 must add up to less than 1e-3. What is lacking to 0 costs speed,
/// not exactness.

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/triangle_selection.h>

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

/// Work of one query.
struct QueryCounters {
  std::int64_t node_tests = 0;      ///< pairs of boxes tested
  std::int64_t realignments = 0;    ///< boxes realigned
  std::int64_t triangle_tests = 0;  ///< pairs of triangles tested
};

/// Scratch memory and counters of the queries. Keep one per thread and reuse it: after a few queries nothing is
/// allocated. Not thread-safe.
class QueryWorkspace {
 public:
  QueryWorkspace();
  ~QueryWorkspace();
  QueryWorkspace(QueryWorkspace&&) noexcept;
  QueryWorkspace& operator=(QueryWorkspace&&) noexcept;

  /// Work of the last query.
  const QueryCounters& counters() const;

  struct Memory;
  Memory& memory() { return *memory_; }

 private:
  std::unique_ptr<Memory> memory_;
};

class CoherentFront;

/// A workspace that remembers the last query of one pair of trees, which makes queries of a pair that moves little from
/// one to the next much cheaper. Answers are the same, bit for bit, as without it. Use one for each pair; a query of
/// other trees, or of a tree that was refitted, makes it start afresh. Not thread-safe.
class CoherentWorkspace {
 public:
  CoherentWorkspace();
  ~CoherentWorkspace();
  CoherentWorkspace(CoherentWorkspace&&) noexcept;
  CoherentWorkspace& operator=(CoherentWorkspace&&) noexcept;

  /// Work of the last query.
  const QueryCounters& counters() const { return workspace_.counters(); }

  /// Starts afresh.
  void forget();

  QueryWorkspace& workspace() { return workspace_; }
  CoherentFront& front() { return *front_; }

 private:
  QueryWorkspace workspace_;
  std::unique_ptr<CoherentFront> front_;
};

/// Whether any two triangles are not further apart than `tolerance` (metres, ≥ 0; 0: intersect). (paper §2.1)
bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace,
                double tolerance = 0.0);
bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                CoherentWorkspace& workspace, double tolerance = 0.0);

/// Replaces `pairs` by every pair of triangles not further apart than `tolerance` (metres, ≥ 0; 0: that intersect), in
/// ascending order.
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance = 0.0);
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        CoherentWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance = 0.0);

/// Replaces `pairs` by every pair of triangles not further apart than `distance` (metres, ≥ 0), in ascending order of
/// the triangle indices, with their closest points; with a selection, by those with a selected triangle, at a cost that
/// follows these. Throws std::invalid_argument for a selection that was made for another tree.
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  QueryWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection = {});
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  CoherentWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection = {});

/// A certain lower bound of the distance of the two meshes in metres: the distance itself but for a few units in the
/// last place of the coordinates, 0 when they intersect; that of their bounding spheres when those are further apart
/// than the larger radius; `limit` when it is less.
double gap_lower_bound(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                       QueryWorkspace& workspace, double limit = std::numeric_limits<double>::infinity());
double gap_lower_bound(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                       CoherentWorkspace& workspace, double limit = std::numeric_limits<double>::infinity());

}  // namespace glissade::collision

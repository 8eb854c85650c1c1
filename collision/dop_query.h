#pragma once

/// Exact queries between two DOP-trees: whether the triangle soups intersect, which triangle pairs intersect or are
/// near, and how far apart the soups are. A guaranteed bound: a translation that separates them.
///
/// Each query takes the pose X_AB of tree B in the frame of tree A. The query transforms the vertices of B by X_AB in
/// double precision. The answer is that of exact real arithmetic on these transformed vertices and the vertices of A.
/// With a tolerance or distance above 0, the distances of triangles that are compared with it are accurate to a few
/// units in the last place of the largest coordinate. Touching counts as intersecting. Only triangles of positive area
/// take part.
///
/// Each query throws std::invalid_argument for trees that were built with different options, for a distance that is
/// negative or not a number, for a pose that is not finite, and for a matrix that is not a rotation: a reflection,
/// or one for which the absolute entries of RᵀR − 1 add up to 1e-3 or more. A smaller deviation costs speed, not
/// exactness.

#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>

namespace glissade::collision {

/// Whether the two meshes are at most `tolerance` (metres, ≥ 0) apart; with tolerance 0, whether they intersect. (paper
/// §2.1)
bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace,
                double tolerance = 0.0);
bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                CoherentWorkspace& workspace, double tolerance = 0.0);

/// Replaces `pairs` by all triangle pairs at most `tolerance` (metres, ≥ 0) apart, in ascending order. With tolerance
/// 0, these are the intersecting pairs.
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance = 0.0);
void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        CoherentWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance = 0.0);

/// Replaces `pairs` by all triangle pairs at most `distance` (metres, ≥ 0) apart, with their closest points, in
/// ascending order of the triangle indices. If `selection` has an entry for both trees, the answer is restricted to
/// selected pairs, and the cost grows with the number of such pairs. A missing entry
/// selects all triangles of its tree, and thus all pairs. Throws std::invalid_argument for a selection that was made
/// for another tree.
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  QueryWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection = {});
void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  CoherentWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection = {});

/// The least distance of two triangles of the two meshes, if it is less than `limit` (metres). The cost hardly depends
/// on how far apart the meshes are, and the less the lower the limit.
MeshDistance distance(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                      QueryWorkspace& workspace, double limit = std::numeric_limits<double>::infinity());
MeshDistance distance(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                      CoherentWorkspace& workspace, double limit = std::numeric_limits<double>::infinity());

/// A translation that separates two meshes.
struct Penetration {
  /// Translation of B in the frame of A after which the meshes are farther apart than the `clearance` that was
  /// given to `find_way_out` (metres). Zero if they are so already.
  Eigen::Vector3d way_out_A = Eigen::Vector3d::Zero();

  double depth() const { return way_out_A.norm(); }
};

/// Finds a short translation of B, from its pose X_AB, after which the meshes are more than `clearance` (metres, ≥ 0)
/// apart. A query at the translated pose has confirmed this.
///
/// Because of this query, the depth is a guaranteed upper bound of the shortest translation that separates the two
/// surfaces. A shorter
/// translation may exist: the search tries directions all around, the normals of intersecting triangles, the axes of
/// both frames and the diagonals between them, and then directions ever closer to the best direction so far, down to a
/// few thousandths of a radian from it. Along axes and diagonals it finds the nearest free place, however small, such
/// as the middle of a hole; along the others it may miss small ones. For convex
/// bodies the depth is within a few per cent of the least depth. Meshes are surfaces without an inside: a body that
/// lies inside a closed surface without touching it is apart from the surface, and the shortest way out of a shell may
/// lead inward. Only the translated pose is tested: on the way to this pose, B may meet A or other objects.
///
/// Deterministic. Cost: a few hundred queries, seldom more than a thousand. Throws as the queries do.
Penetration find_way_out(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                         QueryWorkspace& workspace, double clearance = 0.0);

}  // namespace glissade::collision

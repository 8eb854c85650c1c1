#pragma once

/// Exact polygon-soup queries between two DOP-trees: do they touch, where, and what is near.
///
/// Each takes the pose X_AB of tree B in the frame of tree A. Exact means: the answer is that of real arithmetic for
/// the vertices of A and the vertices of B after X_AB has been applied to them in double precision. Touching counts as
/// intersecting. Only triangles of positive area take part. Each throws std::invalid_argument for trees that were built
/// with different options, for a distance that is negative or not a number, and for a pose that is not finite or whose
/// matrix is not a rotation: the entries of RᵀR − 1 must add up to less than 1e-3. What is lacking to 0 costs speed,
/// not exactness.

#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>

namespace glissade::collision {

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

/// A way out.
struct Penetration {
  /// Translation of B in the frame of A after which the meshes are apart; zero if they are to begin with. Metres.
  Eigen::Vector3d way_out_A = Eigen::Vector3d::Zero();

  double depth() const { return way_out_A.norm(); }
};

/// A short translation of B that brings the meshes further apart than `clearance` (metres, ≥ 0), by the exact queries
/// of `dop_query.h` for the pose X_AB.
///
/// The depth is an upper bound of the translational penetration depth, and certain: the way out has been tried. That it
/// is the shortest is an estimate. Tried are directions all around, those of the triangles that intersect, and then
/// those near the best so far, down to some thousandths of its length; for convex bodies that comes within a few per
/// cent. Meshes are surfaces without inside: what lies within a closed one without touching it is apart, and the
/// shortest way out of a shell may lead into it. Nothing is said of the way itself, on which they may meet others, or
/// each other.
///
/// Deterministic. Cost: some hundred queries. Throws as the queries do.
Penetration find_way_out(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                         QueryWorkspace& workspace, double clearance = 0.0);

}  // namespace glissade::collision

#pragma once

/// Queries between two DOP-trees. Exact queries determine whether the triangle soups intersect, which triangle pairs
/// intersect or are near, and how far apart the soups are. Another query finds a translation that separates the soups.
///
/// Each query takes the pose X_AB of tree B in the frame of tree A. The query transforms the vertices of B by X_AB in
/// double precision. The answer is the result of exact real arithmetic on these transformed vertices and the vertices
/// of A. However, if a tolerance or distance is above 0, computed distances are accurate only to a few units in the
/// last place of the largest coordinate. Touching counts as intersecting. Only triangles of positive area take part.
///
/// Each query throws std::invalid_argument in these cases:
/// - The trees were built with different options.
/// - The distance is negative or not a number; the clearance is not between 0 and 1e9 m.
/// - The pose is not finite, or the absolute values of the coordinates of its translation add up to more than 1e12 m.
/// - The centres of the meshes are farther apart than 1e18 times the radius of the larger mesh.
/// - The matrix R of the pose is a reflection.
/// - The absolute values of the entries of RᵀR − 1 add up to 1e-3 or more. A smaller sum that is not 0 makes queries
///   slower, but not less exact.

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>

namespace glissade::collision {

/// Whether two meshes are at most `tolerance` (metres, ≥ 0) apart (paper §2.1). With tolerance 0, the query tests
/// whether the meshes intersect.
GLISSADE_EXPORT bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                QueryWorkspace& workspace, double tolerance = 0.0);
GLISSADE_EXPORT bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                CoherentWorkspace& workspace, double tolerance = 0.0);

/// Replaces `pairs` by all triangle pairs at most `tolerance` (metres, ≥ 0) apart, in ascending order. With tolerance
/// 0, these are the intersecting pairs.
GLISSADE_EXPORT void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs,
                                        double tolerance = 0.0);
GLISSADE_EXPORT void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                        CoherentWorkspace& workspace, std::vector<TrianglePair>& pairs,
                                        double tolerance = 0.0);

/// Replaces `pairs` by all triangle pairs at most `distance` (metres, ≥ 0) apart, with their closest points, in
/// ascending order of the triangle indices. If `selection` has an entry for each tree, the answer contains only
/// selected pairs, and the cost grows with the number of selected pairs. A missing entry selects all triangles of its
/// tree, and therefore all pairs. Throws std::invalid_argument for a selection that was made for another tree.
GLISSADE_EXPORT void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                  double distance, QueryWorkspace& workspace, std::vector<ClosePair>& pairs,
                                  const PairSelection& selection = {});
GLISSADE_EXPORT void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                  double distance, CoherentWorkspace& workspace, std::vector<ClosePair>& pairs,
                                  const PairSelection& selection = {});

/// The least distance between a triangle of A and a triangle of B, if this distance is less than `limit` (metres). The
/// cost hardly depends on the distance. A smaller `limit` reduces the cost.
GLISSADE_EXPORT MeshDistance distance(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                      QueryWorkspace& workspace,
                                      double limit = std::numeric_limits<double>::infinity());
GLISSADE_EXPORT MeshDistance distance(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                      CoherentWorkspace& workspace,
                                      double limit = std::numeric_limits<double>::infinity());

/// A translation that separates two meshes.
struct Penetration {
  /// Translation of B in the frame of A (metres) after which the meshes are farther apart than the `clearance` given to
  /// `find_way_out`. Zero if no translation is needed.
  Eigen::Vector3d way_out_A = Eigen::Vector3d::Zero();

  double depth() const { return way_out_A.norm(); }
};

/// Finds a short translation of B, from its pose X_AB, after which the meshes are more than `clearance` (metres, 0 to
/// 1e9) apart. A query at the translated pose confirms the result.
///
/// Because of this confirmation, the depth is a guaranteed upper bound of the length of the shortest translation that
/// separates the two surfaces. A shorter translation may exist. The search tries directions of the whole sphere, the
/// normals of intersecting triangles, the axes of both frames and the diagonals between the axes. Then the search
/// refines the best direction to a few thousandths of a radian. Along axes and diagonals, the search finds the nearest
/// free place, however small, such as the middle of a hole. Along other directions, the search may miss small free
/// places. For convex bodies, the depth is within a few per cent of the least depth. Meshes are surfaces without an
/// inside. So a body in a closed surface counts as apart unless it touches the surface, and the shortest way out of a
/// shell may lead inward. Only the translated pose is tested. On the path to this pose, B may meet A or other objects.
///
/// Deterministic. Cost: a few hundred queries, seldom more than a thousand. Throws in the same cases as the other
/// queries.
GLISSADE_EXPORT Penetration find_way_out(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                         QueryWorkspace& workspace, double clearance = 0.0);

/// A motion of B in the frame of A, for t from 0 to 1. The reference point moves along a straight line at a constant
/// velocity, and B turns about this point at a constant angular velocity, by the smallest angle (at most 180°) that
/// leads to the orientation at the end.
struct GLISSADE_EXPORT RigidMotion {
  Eigen::Isometry3d X_AB_begin = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_AB_end = Eigen::Isometry3d::Identity();
  Eigen::Vector3d p_Bref = Eigen::Vector3d::Zero();  ///< the reference point, in the frame of B, metres

  Eigen::Isometry3d X_AB(double t) const;
};

/// Where a motion first leads to a contact.
struct FirstContact {
  double t;         ///< from 0 to 1
  ClosePair close;  ///< two triangles that are at most the tolerance apart at t
};

/// The first contact of two meshes in a motion (continuous collision detection). The time is conservative: at all
/// earlier times, the meshes are more than half the `tolerance` (metres, > 0) apart, and at t, they are at most the
/// tolerance apart. Empty if the meshes stay more than half the tolerance apart until t = 1.
///
/// Method: conservative advancement (Mirtich 1996) of many pairs, ordered by the time until which each pair is proven
/// apart, as in a kinetic separation list (Weller and Zachmann 2006). A pair of boxes, or of triangles, is apart as
/// long as one direction separates it: the gap along this direction, less what speed and acceleration of the pair's
/// points can take from it. If the proof of a pair of boxes ends, the boxes are replaced by their children.
///
/// Deterministic. Thread-safe. Allocates. The first call for a tree makes its oriented boxes (`DopTree::obb_tree`). A
/// part that slides at little more than the tolerance along large triangles while turning takes many steps, at most
/// about the length of the way divided by the tolerance for each pair.
///
/// Throws std::invalid_argument for poses as the other queries do, for matrices that are not rotations to nine digits,
/// and for a tolerance that is not above the rounding errors, about 2e-13 of the largest length.
GLISSADE_EXPORT std::optional<FirstContact> first_contact(const DopTree& tree_A, const DopTree& tree_B,
                                                          const RigidMotion& motion, double tolerance = 1e-6);

// Traversal of two trees with a user-defined cut-off. It visits pairs of children, i.e. a child of a node of tree A and
// a child of a node of tree B. A visitor can accept such a pair as a whole, for example two flush plane patches. The
// traversal then skips all triangle pairs below the accepted pair, or all except selected pairs.

/// One child of the node with the number `node`. `child` is the index of the child in this node, from 0 to
/// `TreeNode::child_count` − 1.
struct TreeChild {
  std::uint32_t node;
  int child;
};

/// The kind of a direction that separates two triangles: perpendicular to the triangle of A, perpendicular to the
/// triangle of B, or another direction.
enum class Separator : std::uint8_t { kPlaneOfA, kPlaneOfB, kOther };

/// Two triangles, and a direction that separates them.
struct NearTriangles {
  TrianglePair triangles;
  Eigen::Vector3d n_A;  ///< unit, from A to B, in the frame of A; zero if no separating direction is known
  double gap;           ///< metres, ≥ 0: lower bound of the gap between the triangles along n_A
  Separator separator;  ///< the kind of n_A
};

/// Receives the pairs of children and the pairs of triangles.
class GLISSADE_EXPORT DualTreeVisitor {
 public:
  /// Returns whether the visitor accepts two children. Called only for children that are not proven to be farther apart
  /// than `NearDistances::within`. The traversal skips all pairs below two accepted children.
  virtual bool accepts(const TreeChild& child_A, const TreeChild& child_B) = 0;
  /// Receives a triangle pair that does not lie below an accepted pair.
  virtual void visit(const NearTriangles& pair) = 0;
  /// Receives a selected triangle pair that lies below an accepted pair.
  virtual void visit_below_accepted(const NearTriangles& /*pair*/) {}

 protected:
  ~DualTreeVisitor() = default;
};

/// Distances of a traversal (metres, ≥ 0).
struct NearDistances {
  double within;       ///< greatest distance of the triangle pairs that the traversal must find
  double exact_below;  ///< a triangle pair is measured exactly if all tried directions separate it by less than this
};

/// Passes to the visitor all triangle pairs at most `distances.within` apart, except the triangle pairs below accepted
/// pairs of children. Afterwards, if `below_accepted` has two selections, the traversal passes the selected triangle
/// pairs below accepted pairs. For each triangle pair, the traversal tries several directions: the normals of both
/// triangles, cross products of their edges, and directions across an edge in the plane of its triangle. If a direction
/// separates the pair by at least `distances.exact_below`, n_A is the best of these directions, in single precision.
/// Such a pair may be a little farther apart than `distances.within`. All other pairs are measured exactly, which takes
/// several times as long. For a measured pair, n_A is the direction between the closest points. Deterministic,
/// including the order. Allocates nothing once the workspace is large enough. The visitor must not use the workspace
/// for queries. Throws std::invalid_argument for distances that are negative or not numbers, and in the same cases as
/// the other queries.
GLISSADE_EXPORT void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                                   const NearDistances& distances, QueryWorkspace& workspace, DualTreeVisitor& visitor,
                                   const PairSelection* below_accepted = nullptr);

}  // namespace glissade::collision

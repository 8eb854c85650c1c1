#pragma once

/// Dual-tree traversal with a user-defined cut-off. The traversal visits pairs of children, i.e. a child of a node of
/// tree A and a child of a node of tree B. A visitor can accept such a pair as a whole, for example two flush plane
/// patches. The traversal then skips all triangle pairs below the accepted pair, or all except selected pairs.

#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

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
class DualTreeVisitor {
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
/// for queries. Throws std::invalid_argument for distances that are negative or not numbers. Also throws in the same
/// cases as the queries of `dop_query.h`.
void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                   const NearDistances& distances, QueryWorkspace& workspace, DualTreeVisitor& visitor,
                   const PairSelection* below_accepted = nullptr);

}  // namespace glissade::collision

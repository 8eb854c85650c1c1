#pragma once

/// Dual-tree traversal with a user-defined cut-off. The traversal visits pairs of children: a child of a node of tree A
/// and a child of a node of tree B. A visitor may accept such a pair as a whole, for example two flush plane patches;
/// the traversal then skips all pairs below the accepted pair, or all but selected ones.

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

/// Receives the pairs of children in the order of the traversal, and then the pairs of triangles.
class DualTreeVisitor {
 public:
  /// Whether the visitor accepts two children. Called only for children whose bounding volumes may be within the
  /// distance. The traversal skips all pairs below two accepted children.
  virtual bool accepts(const TreeChild& child_A, const TreeChild& child_B) = 0;
  /// Receives a triangle pair within the distance that does not lie below an accepted pair.
  virtual void visit(const ClosePair& pair) = 0;
  /// Receives a selected triangle pair within the distance that lies below an accepted pair.
  virtual void visit_below_accepted(const ClosePair& /*pair*/) {}

 protected:
  ~DualTreeVisitor() = default;
};

/// Passes to the visitor all triangle pairs at most `distance` (metres, ≥ 0) apart, except the triangle pairs below
/// accepted pairs of children. Of these it passes the selected ones afterwards, unless `below_accepted` is null or has
/// a null selection. Deterministic: the order of the triangle pairs is that of the traversal. Allocates nothing once
/// the workspace has grown. The visitor must not query with the workspace. Throws as the queries of `dop_query.h` do.
void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                   QueryWorkspace& workspace, DualTreeVisitor& visitor, const PairSelection* below_accepted = nullptr);

}  // namespace glissade::collision

#pragma once

/// All that is near of two trees, for those who know better than by triangles: a visitor may take on what two children
/// of nodes hold as a whole, such as two plane patches that lie flush, and then nothing below them is looked at.

#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

/// A child of a node, which must have it.
struct TreeChild {
  std::uint32_t node;
  int child;
};

/// What is asked, and told, in the order of the traversal.
class DualTreeVisitor {
 public:
  /// Two children whose boxes may be near: whether the visitor takes on all that both hold.
  virtual bool accepts(const TreeChild& child_A, const TreeChild& child_B) = 0;
  /// A pair of triangles not further apart than the distance, of children that were not taken.
  virtual void visit(const ClosePair& pair) = 0;

 protected:
  ~DualTreeVisitor() = default;
};

/// Shows the visitor all pairs of triangles not further apart than `distance` (metres, ≥ 0), but for what it takes on.
/// Deterministic. Allocates nothing once the workspace has grown.
void traverse_near(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                   QueryWorkspace& workspace, DualTreeVisitor& visitor);

}  // namespace glissade::collision

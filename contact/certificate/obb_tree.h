#pragma once

/// OBB tree: oriented bounding boxes of a DOP-tree's nodes in full precision. The slabs of the DOP-tree itself lie on a
/// 16-bit grid. That suffices to find near pairs; certificates at micrometres need more.

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::contact {

/// All points x with |axes.col(i)·(x − c)| ≤ half_size[i] and |x − c| ≤ radius; metres. The axes are orthonormal, the
/// first is the direction of least thickness: the box of a plane patch is as flat as rounding allows, however large the
/// patch is. A negative radius marks an empty box.
struct Obb {
  Eigen::Vector3d c;
  Eigen::Matrix3d axes;
  Eigen::Vector3d half_size;
  double radius;

  /// Half of the extent of the box along a unit vector n, metres.
  double extent_along(const Eigen::Vector3d& n) const { return half_size.dot((axes.transpose() * n).cwiseAbs()); }
};

/// A box for every child of every node, in the frame of the tree. Immutable after construction, so safe to share
/// between threads.
class ObbTree {
 public:
  /// The tree must not be refitted afterwards. Cost O(n log n).
  explicit ObbTree(const collision::DopTree& tree);

  /// The box of the triangles below a child, which the node must have.
  const Obb& box(std::uint32_t node, int child) const {
    return boxes_[static_cast<std::size_t>(collision::DopTree::kWidth) * node + static_cast<std::size_t>(child)];
  }

 private:
  std::vector<Obb> boxes_;
};

}  // namespace glissade::contact

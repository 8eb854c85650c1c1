#pragma once

/// Oriented boxes of a DOP-tree's nodes at full precision. The tree's own slabs are on a grid of 16 bits, which is fine
/// to tell what may be near; proofs at micrometres need more.

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::haptics {

/// Holds points x with |axes.col(i)·(x − c)| ≤ half_size[i], and |x − c| ≤ radius; metres. The axes are orthonormal,
/// and the first is that of the least thickness: what lies in a plane patch has a box as flat as rounding, however
/// large it is. A negative radius: it holds nothing.
struct Obb {
  Eigen::Vector3d c;
  Eigen::Matrix3d axes;
  Eigen::Vector3d half_size;
  double radius;

  /// How far its points are from c along a unit vector n at most.
  double extent_along(const Eigen::Vector3d& n) const { return half_size.dot((axes.transpose() * n).cwiseAbs()); }
};

/// A box for every child of every node, in the frame of the tree. Immutable after construction, so safe to share
/// between threads.
class ObbTree {
 public:
  /// The tree must not be refitted afterwards. Cost O(n log n).
  explicit ObbTree(const collision::DopTree& tree);

  /// That of the triangles below a child, which the node must have.
  const Obb& box(std::uint32_t node, int child) const {
    return boxes_[static_cast<std::size_t>(collision::DopTree::kWidth) * node + static_cast<std::size_t>(child)];
  }

 private:
  std::vector<Obb> boxes_;
};

}  // namespace glissade::haptics

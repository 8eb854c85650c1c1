#pragma once

/// The box around an object where it is, for the broad phase.

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

/// Encloses the vertices of the tree at the pose X_WO, axis-aligned in the world, metres: the box of the mesh, turned
/// and boxed again, cut by that of its bounding sphere. Rounded outward so that two objects whose boxes are apart are
/// apart for every query at the pose of one seen from the other, whatever that rounds, for all poses that `rigid_pose`
/// returns. Cost: some nanoseconds.
Eigen::AlignedBox3d world_box(const DopTree& tree, const Eigen::Isometry3d& X_WO);

}  // namespace glissade::collision

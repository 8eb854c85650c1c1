#pragma once

/// The axis-aligned bounding box of an object in the world, for the broad phase.

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

/// An axis-aligned box in the world (metres) that encloses the vertices of the tree at the pose X_WO: the box of the
/// rotated box of the mesh, intersected with the box of its bounding sphere. Rounded outward: for all poses that
/// `rigid_pose` returns, two objects whose boxes are apart are apart for every query at their relative pose, including
/// its rounding. Cost: a few nanoseconds.
Eigen::AlignedBox3d world_box(const DopTree& tree, const Eigen::Isometry3d& X_WO);

}  // namespace glissade::collision

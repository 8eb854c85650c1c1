#pragma once

/// Poses as they come from outside: files and single precision leave matrices that are not quite rotations.

#include <optional>

#include <Eigen/Geometry>

namespace glissade::collision {

/// The pose itself if the entries of RᵀR − 1 add up to less than 1e-12, as those of every product of a few rotations
/// do; with the nearest rotation instead if they add up to less than 1e-4; else none, nor for a reflection, or for a
/// coordinate that is not finite or beyond ±1e9 m. So bounds that hold for rotations hold for what is returned. Cost:
/// some ten nanoseconds.
std::optional<Eigen::Isometry3d> rigid_pose(const Eigen::Isometry3d& X) noexcept;

}  // namespace glissade::collision

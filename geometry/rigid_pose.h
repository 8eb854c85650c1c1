#pragma once

/// Matrices that are almost rotations: how far off they are, and the rigid pose nearest to one.

#include <cmath>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::geometry {

/// The pose itself if the entries of RᵀR − 1 add up to less than 1e-12, as those of every product of a few rotations
/// do; with the nearest rotation instead if they add up to less than 1e-4; else none, nor for a reflection, or for a
/// coordinate that is not finite or beyond ±1e9 m. So bounds that hold for rotations hold for what is returned. Cost:
/// some ten nanoseconds.
std::optional<Eigen::Isometry3d> rigid_pose(const Eigen::Isometry3d& X) noexcept;

/// The absolute values of the entries of RᵀR − 1, added up: 0 of a true rotation or reflection, and a bound of any
/// norm. Not a number when an entry of R is not finite.
inline double rotation_defect(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d x = R.col(0);
  const Eigen::Vector3d y = R.col(1);
  const Eigen::Vector3d z = R.col(2);
  return std::abs(x.squaredNorm() - 1.0) + std::abs(y.squaredNorm() - 1.0) + std::abs(z.squaredNorm() - 1.0) +
         2.0 * (std::abs(x.dot(y)) + std::abs(y.dot(z)) + std::abs(z.dot(x)));
}

/// No less than `rotation_defect`, if that is little, and 0 of a true rotation; more than 1 of a reflection. Quicker.
inline double rotation_defect_bound(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d x = R.col(0);
  const Eigen::Vector3d y = R.col(1);
  const double xy = std::abs(x.squaredNorm() - 1.0) + std::abs(y.squaredNorm() - 1.0) + 2.0 * std::abs(x.dot(y));
  return 3.0 * xy + 7.0 * (x.cross(y) - R.col(2)).lpNorm<1>();
}

/// Whether R, of little defect, is a rotation and not a reflection.
inline bool is_right_handed(const Eigen::Matrix3d& R) {
  return R.col(0).cross(R.col(1)).dot(R.col(2)) > 0.0;
}

}  // namespace glissade::geometry

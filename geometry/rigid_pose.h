#pragma once

/// The rigid pose nearest to an almost rigid pose, and measures of the deviation of a matrix from a rotation.

#include <cmath>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::geometry {

/// The rigid pose nearest to an almost rigid X = (R, p). Returns X itself if the `rotation_defect` of R (declared
/// below) is below 1e-12. Every product of a few rotations has so small a defect. Replaces R by the nearest rotation if
/// the defect is between 1e-12 and 1e-4. Returns nothing for a larger defect, for a reflection, and for a coordinate of
/// p that is not finite or beyond ±1e9 m. The rotation of a result thus has a defect below 1e-12, so error bounds
/// derived for rotations hold for the result. Cost: about ten nanoseconds.
std::optional<Eigen::Isometry3d> rigid_pose(const Eigen::Isometry3d& X) noexcept;

/// The defect δ: the sum of the absolute entries of RᵀR − 1, where 1 is the identity matrix. The defect is 0 for an
/// exact rotation or reflection, and an upper bound of every common norm of RᵀR − 1. The defect is not finite when R
/// has an entry that is not finite.
inline double rotation_defect(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d x = R.col(0);
  const Eigen::Vector3d y = R.col(1);
  const Eigen::Vector3d z = R.col(2);
  return std::abs(x.squaredNorm() - 1.0) + std::abs(y.squaredNorm() - 1.0) + std::abs(z.squaredNorm() - 1.0) +
         2.0 * (std::abs(x.dot(y)) + std::abs(y.dot(z)) + std::abs(z.dot(x)));
}

/// An upper bound of `rotation_defect` for matrices of small defect, faster to compute than the defect itself. The
/// bound is 0 for an exact rotation, and more than 1 for a reflection.
inline double rotation_defect_bound(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d x = R.col(0);
  const Eigen::Vector3d y = R.col(1);
  const double xy = std::abs(x.squaredNorm() - 1.0) + std::abs(y.squaredNorm() - 1.0) + 2.0 * std::abs(x.dot(y));
  return 3.0 * xy + 7.0 * (x.cross(y) - R.col(2)).lpNorm<1>();
}

/// Whether R, a matrix of small defect, approximates a rotation rather than a reflection.
inline bool is_right_handed(const Eigen::Matrix3d& R) {
  return R.col(0).cross(R.col(1)).dot(R.col(2)) > 0.0;
}

}  // namespace glissade::geometry

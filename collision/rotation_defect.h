#pragma once

#include <cmath>

#include <Eigen/Core>

namespace glissade::collision {

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

}  // namespace glissade::collision

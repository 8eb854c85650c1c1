#pragma once

/// Short functions for poses and rotations.

#include <numbers>

#include <Eigen/Geometry>

namespace glissade::test_support {

inline Eigen::Isometry3d pose(const Eigen::Vector3d& p, const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = q.toRotationMatrix();
  X.translation() = p;
  return X;
}

/// The pose at these coordinates without rotation.
inline Eigen::Isometry3d at(double x, double y = 0.0, double z = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A rotation by `angle` radians about `axis`, which need not be of unit length.
inline Eigen::Quaterniond turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// The shortest rotation from one direction to another. Eigen's FromTwoVectors includes an SVD that takes long to
/// compile.
inline Eigen::Quaterniond turn_from_to(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const double length = from.norm() * to.norm();
  Eigen::Quaterniond q;
  q.vec() = from.cross(to);
  q.w() = length + from.dot(to);
  if (q.norm() < 1e-9 * length) q = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, from.unitOrthogonal()));
  return q.normalized();
}

}  // namespace glissade::test_support

#pragma once

/// Vectors and poses of the C interface, and Eigen's.

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include <glissade/files/pose_rules.h>

#include "glissade.h"

namespace glissade::c {

/// Throws std::invalid_argument, naming the argument, for a number that is not finite.
inline Eigen::Vector3d vector_of(const double* values, const char* argument) {
  const Eigen::Vector3d vector = Eigen::Map<const Eigen::Vector3d>(values);
  if (!vector.allFinite()) throw std::invalid_argument(std::string(argument) + " has a number that is not finite");
  return vector;
}

/// The same, also for a quaternion that is no unit.
inline Eigen::Isometry3d pose_of(const GlissadePose& pose, const char* argument) {
  return files::checked_pose(vector_of(&pose.x, argument), Eigen::Quaterniond(pose.qw, pose.qx, pose.qy, pose.qz),
                             argument);
}

inline GlissadePose pose_of(const Eigen::Isometry3d& X) noexcept {
  const Eigen::Quaterniond q(X.linear());
  return {X.translation().x(), X.translation().y(), X.translation().z(), q.w(), q.x(), q.y(), q.z()};
}

inline void copy(const Eigen::Vector3d& vector, double (&out)[3]) noexcept {
  Eigen::Map<Eigen::Vector3d>(+out) = vector;
}

/// One number for each joint of a hand.
inline void copy(const std::array<double, GLISSADE_JOINTS>& values, double (&out)[GLISSADE_JOINTS]) noexcept {
  for (std::size_t i = 0; i < values.size(); ++i)
    out[i] = values[i];
}
inline std::array<double, GLISSADE_JOINTS> joints_of(const double (&values)[GLISSADE_JOINTS]) noexcept {
  return std::to_array(values);
}

}  // namespace glissade::c

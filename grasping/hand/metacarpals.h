#pragma once

/// Where the metacarpals are in the palm.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "hand/hand_proportions.h"

namespace glissade::grasping {

/// The pose of a finger's metacarpal, at its CMC joint and pointing to the knuckle, in the palm of a right hand with
/// this length and breadth. All CMC joints are equally far from the wrist; the length of the bone says where across the
/// palm.
inline Eigen::Isometry3d metacarpal_pose(std::size_t finger, double hand_length, double hand_breadth) {
  const FingerProportions& ratios = kFingerProportions[finger];
  const double yaw = std::copysign(std::acos(std::min(1.0, (ratios.mcp_x - kCmc_x) / ratios.metacarpal)), ratios.mcp_y);
  const double y = ratios.mcp_y * hand_breadth - ratios.metacarpal * hand_length * std::sin(yaw);
  return Eigen::Translation3d(kCmc_x * hand_length, y, 0.0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

/// The mirror image of a pose at y = 0: the same in a left hand.
inline Eigen::Isometry3d mirrored(const Eigen::Isometry3d& X) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1.0, -1.0, 1.0);
  Eigen::Isometry3d X_mirrored = X;
  X_mirrored.linear() = mirror * X.linear() * mirror;
  X_mirrored.translation() = mirror * X.translation();
  return X_mirrored;
}

}  // namespace glissade::grasping

#pragma once

/// The poses of Zachmann's procedure (paper §2.1.2) for two copies of an object.

#include <vector>

#include <Eigen/Geometry>

#include "pose_source.h"

namespace glissade::bench {

/// Distances along each axis of approach.
inline constexpr std::size_t kZachmannDistances = 10;

/// Random orientations, and five random axes for each. Along each axis, distances at equal steps from 0, where the
/// centres coincide, to 1.001 times the separation of the bounding boxes: some parts have flat faces on their boxes,
/// and at exactly touching boxes rounding would decide. Poses of one axis follow each other.
inline std::vector<Eigen::Isometry3d> zachmann_poses(PoseSource& source, bool quick) {
  const int orientations = quick ? 10 : 20;
  constexpr int kAxes = 5;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < orientations; ++i) {
    const Eigen::Matrix3d R_AB = source.rotation();
    for (int j = 0; j < kAxes; ++j) {
      const Eigen::Vector3d axis = source.direction();
      const double apart = 1.001 * source.box_separation(R_AB, axis);
      for (std::size_t k = 0; k < kZachmannDistances; ++k)
        poses.push_back(pose(R_AB, apart * static_cast<double>(k) / (kZachmannDistances - 1) * axis));
    }
  }
  return poses;
}

}  // namespace glissade::bench

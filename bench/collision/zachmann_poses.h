#pragma once

/// The poses of Zachmann's procedure (paper §2.1.2) for two copies of an object.

#include <vector>

#include <Eigen/Geometry>

#include "pose_source.h"

namespace glissade::bench {

/// Distances along each axis of approach.
inline constexpr std::size_t kZachmannDistances = 10;

/// For random orientations, and for each of them five random axes: distances evenly from 0, where the centres coincide,
/// to where the bounding boxes have just come apart: by a thousandth, because parts have flat faces on their boxes, and
/// whether touching boxes touch would be a matter of rounding. Poses of one axis follow each other.
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

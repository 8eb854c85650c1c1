#pragma once

/// Where a chain is: the paper's (M, F), the pose of the root and the flex vector (paper §4).

#include <vector>

#include <Eigen/Geometry>

namespace glissade::grasping {

struct Posture {
  Eigen::Isometry3d X_WR = Eigen::Isometry3d::Identity();  ///< of the root
  std::vector<double> values;                              ///< rad, one for each flex value of the chain
};

}  // namespace glissade::grasping

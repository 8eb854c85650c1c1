#pragma once

/// The joints of a hand that closes round a ball in its palm.

#include <array>
#include <cstddef>
#include <memory>
#include <numbers>

#include <Eigen/Geometry>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/hands/hand.h>

#include "poses.h"

namespace glissade::test_support {

/// The joints of thumb and fingers, the latter all alike; degrees.
inline hands::JointValues finger_joints(const std::array<double, 4>& thumb, const std::array<double, 3>& finger) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  hands::JointValues angles{};
  for (std::size_t i = 0; i < 4; ++i)
    angles[i] = kDegree * thumb[i];
  for (const std::size_t first : {4U, 7U, 11U, 15U}) {
    for (std::size_t i = 0; i < 3; ++i)
      angles[first + i] = kDegree * finger[i];
  }
  return angles;
}

inline const hands::JointValues kOpenHand = finger_joints({20, -10, -15, 35}, {-15, 0, -5});
/// A fist much smaller than the ball.
inline const hands::JointValues kClosedHand = finger_joints({60, 45, 40, 20}, {55, 75, 55});

/// A ball in the open palm of a hand with its root at the origin.
inline std::shared_ptr<const geometry::TriangleMesh> ball_for_hand() {
  return std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.035, 2000));
}
inline const Eigen::Isometry3d kBallInHand = at(0.07, -0.006, -0.057);

}  // namespace glissade::test_support

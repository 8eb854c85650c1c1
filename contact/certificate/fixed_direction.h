#pragma once

/// Directions that are fixed to one of two bodies, and turn with it. Where a part turns, such as a nut on its thread,
/// the normals of the outer one of two curved faces separate all that passes inside of it: they last longest if they
/// turn with the body to which they belong.

#include <algorithm>

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::contact {

/// A direction from the obstacle to the part.
struct FixedDirection {
  Eigen::Vector3d n;             ///< unit, in the axes of the body to which it is fixed
  bool turns_with_part = false;  ///< it is fixed to the part; otherwise to the obstacle
};

/// A ball about the part. A direction turns with the part only if the corners of the obstacle's triangle are in there:
/// what it may lose between the ends of a step grows with their distance.
struct BallAboutPart {
  Eigen::Vector3d center_O;  ///< in the frame of the obstacle
  double radius;             ///< metres

  /// The ball of the pose X_OV of the part.
  static BallAboutPart at(const Eigen::Isometry3d& X_OV, const collision::DopTree& part) {
    constexpr double kRadii = 2.0;
    return {X_OV * part.center(), kRadii * part.radius()};
  }

  bool holds(const geometry::TrianglePoints& obstacle_O) const {
    return std::all_of(obstacle_O.begin(), obstacle_O.end(),
                       [&](const Eigen::Vector3d& y) { return (y - center_O).squaredNorm() <= radius * radius; });
  }
  /// Bound (metres) of the distance of its points from p_O.
  double farthest_from(const Eigen::Vector3d& p_O) const { return radius + (p_O - center_O).norm(); }
};

}  // namespace glissade::contact

#pragma once

/// Angles of hinges that come nearest to a measured rotation, in the sense of least squares over the entries of the
/// rotation matrix. Axes are unit vectors. O(1).

#include <Eigen/Core>

namespace glissade::grasping {

/// The angle a for which the rotation by a about `axis` is nearest to R.
double hinge_angle(const Eigen::Matrix3d& R, const Eigen::Vector3d& axis);

struct TwoAngles {
  double first;
  double second;
};

/// The angles a, b for which Rot(first, a) · Rot(second, b) is near to R; exact if R is such a product. The axes must
/// be perpendicular. The vector `bone`, perpendicular to `second`, counts `weight` times as much as `second` itself:
/// with a weight of 0, the image of `second` alone decides about a.
TwoAngles two_hinge_angles(const Eigen::Matrix3d& R, const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                           const Eigen::Vector3d& bone, double weight);

}  // namespace glissade::grasping

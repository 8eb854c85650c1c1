#pragma once

/// Exact orientation predicates for points in double precision, the basis of the triangle predicates.
///
/// A rounded determinant with an error bound decides nearly every call; exact arithmetic decides the rest. Exact for
/// coordinates that are 0 or of magnitude 1e-75 to 1e75, where nothing underflows or overflows. No allocation.

#include <Eigen/Core>

namespace glissade::geometry {

/// Sign of det[a − d, b − d, c − d]: positive when d sees the triangle a, b, c clockwise, 0 when all four lie in a
/// plane.
int orient3d_sign(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                  const Eigen::Vector3d& d);

/// Sign of the area of a, b, c projected along coordinate `axis` (0, 1, 2): positive when they turn counter-clockwise
/// seen from the positive end of the axis, 0 when the projections lie on a line.
int orient2d_sign(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, int axis);

}  // namespace glissade::geometry

#pragma once

/// The bounding volumes of pqp/tree.h, fitted to triangles in double precision.

#include <span>

#include <Eigen/Core>

namespace glissade::bench::pqp {

/// Both volumes have the axes of N; M is the frame of the points.
struct Bounds {
  Eigen::Matrix3d R_MN;  ///< the longest extent first
  Eigen::Vector3d p_MC;  ///< centre of the box
  Eigen::Vector3d half;  ///< half of its extents
  Eigen::Vector3d p_MO;  ///< corner of the rectangle, which spans the first two axes
  Eigen::Vector2d sides;
  double radius = 0.0;
};

/// Of triangles, each of which is three of the points.
Bounds fit_bounds(std::span<const Eigen::Vector3d> points_M);

}  // namespace glissade::bench::pqp

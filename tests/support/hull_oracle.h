#pragma once

/// The distance of two convex hulls by CGAL's quadratic programming in exact arithmetic: slow, and independent of
/// `separating_plane.h`.

#include <Eigen/Geometry>

#include <glissade/collision/convex_hull.h>

namespace glissade::test_support {

/// The corners of B are transformed in double precision; from there on all is exact.
class HullOracle {
 public:
  HullOracle(const collision::ConvexHull& hull_A, const collision::ConvexHull& hull_B, const Eigen::Isometry3d& X_AB);

  bool apart() const { return apart_; }
  double distance() const { return distance_; }  ///< metres; the exact one, rounded

 private:
  bool apart_;
  double distance_;
};

}  // namespace glissade::test_support

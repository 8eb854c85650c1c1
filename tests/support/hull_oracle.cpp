#include "hull_oracle.h"

#include <cmath>
#include <vector>

#include <CGAL/Cartesian.h>
#include <CGAL/Gmpzf.h>
#include <CGAL/Polytope_distance_d.h>
#include <CGAL/Polytope_distance_d_traits_3.h>

namespace glissade::test_support {
namespace {

using Kernel = CGAL::Cartesian<double>;
using Distance = CGAL::Polytope_distance_d<CGAL::Polytope_distance_d_traits_3<Kernel, CGAL::Gmpzf, double>>;

std::vector<Kernel::Point_3> corners(const collision::ConvexHull& hull, const Eigen::Isometry3d& X) {
  std::vector<Kernel::Point_3> points;
  for (const Eigen::Vector3d& vertex : hull.vertices()) {
    const Eigen::Vector3d x = X * vertex;
    points.emplace_back(x.x(), x.y(), x.z());
  }
  return points;
}

}  // namespace

HullOracle::HullOracle(const collision::ConvexHull& hull_A, const collision::ConvexHull& hull_B,
                       const Eigen::Isometry3d& X_AB) {
  const std::vector<Kernel::Point_3> a = corners(hull_A, Eigen::Isometry3d::Identity());
  const std::vector<Kernel::Point_3> b = corners(hull_B, X_AB);
  const Distance distance(a.begin(), a.end(), b.begin(), b.end());
  apart_ = !CGAL::is_zero(distance.squared_distance_numerator());
  distance_ = std::sqrt(CGAL::to_double(distance.squared_distance_numerator()) /
                        CGAL::to_double(distance.squared_distance_denominator()));
}

}  // namespace glissade::test_support

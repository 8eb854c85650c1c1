#include "hull_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <CGAL/Cartesian.h>
#include <CGAL/Gmpzf.h>
#include <CGAL/Polytope_distance_d.h>
#include <CGAL/Polytope_distance_d_traits_3.h>
#include <CGAL/determinant.h>

namespace glissade::test_support {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Cartesian<double>;
using Exact = CGAL::Gmpzf;
using Distance = CGAL::Polytope_distance_d<CGAL::Polytope_distance_d_traits_3<Kernel, Exact, double>>;
__extension__ using Quad = __float128;
using ExactVector = std::array<Exact, 3>;

std::vector<Kernel::Point_3> cgal_points(const std::vector<Vector3d>& points) {
  std::vector<Kernel::Point_3> result;
  for (const Vector3d& x : points)
    result.emplace_back(x.x(), x.y(), x.z());
  return result;
}

// Sum of three exact products of doubles; only the sum is rounded.
Quad height(const Vector3d& n, const Vector3d& x) {
  return Quad(n.x()) * Quad(x.x()) + Quad(n.y()) * Quad(x.y()) + Quad(n.z()) * Quad(x.z());
}

double largest(const std::vector<Vector3d>& points) {
  double most = 0.0;
  for (const Vector3d& x : points)
    most = std::max(most, x.lpNorm<1>());
  return most;
}

int sign_of_volume(const ExactVector& a, const ExactVector& b, const ExactVector& c) {
  return CGAL::sign(CGAL::determinant(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]));
}

}  // namespace

HullOracle::HullOracle(std::span<const Vector3d> points_A, std::span<const Vector3d> points_B,
                       const Eigen::Isometry3d& X_AB)
    : points_A_(points_A.begin(), points_A.end()), X_AB_(X_AB) {
  for (const Vector3d& x : points_B)
    points_B_.emplace_back(X_AB * x);
}

bool HullOracle::proves_apart(const Vector3d& n_A, double gap) const {
  auto reach_A = Quad(-std::numeric_limits<double>::infinity());
  auto reach_B = Quad(std::numeric_limits<double>::infinity());
  for (const Vector3d& x : points_A_)
    reach_A = std::max(reach_A, height(n_A, x));
  for (const Vector3d& x : points_B_)
    reach_B = std::min(reach_B, height(n_A, x));
  const Quad error = Quad(1e-32) * Quad(n_A.lpNorm<1>()) * Quad(largest(points_A_) + largest(points_B_));
  return reach_B - reach_A > Quad(gap) * Quad(n_A.norm()) + error;
}

bool HullOracle::proves_meeting(const std::array<PointPair, 4>& pairs) const {
  std::array<ExactVector, 4> w;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d a = pairs[i][0];
    const Vector3d b = X_AB_ * pairs[i][1];
    if (std::find(points_A_.begin(), points_A_.end(), a) == points_A_.end()) return false;
    if (std::find(points_B_.begin(), points_B_.end(), b) == points_B_.end()) return false;
    for (int k = 0; k < 3; ++k)
      w[i][static_cast<std::size_t>(k)] = Exact(b[k]) - Exact(a[k]);
  }
  // Seen from the origin, all faces turn the same way.
  const std::array<int, 4> signs{sign_of_volume(w[0], w[1], w[2]), sign_of_volume(w[0], w[3], w[1]),
                                 sign_of_volume(w[0], w[2], w[3]), sign_of_volume(w[1], w[3], w[2])};
  return std::all_of(signs.begin(), signs.end(), [&](int sign) { return sign != 0 && sign == signs[0]; });
}

double HullOracle::distance() const {
  const std::vector<Kernel::Point_3> a = cgal_points(points_A_);
  const std::vector<Kernel::Point_3> b = cgal_points(points_B_);
  const Distance distance(a.begin(), a.end(), b.begin(), b.end());
  const Exact square = distance.squared_distance_numerator();
  if (CGAL::is_zero(square)) return 0.0;
  return std::max(std::sqrt(CGAL::to_double(square) / CGAL::to_double(distance.squared_distance_denominator())),
                  std::numeric_limits<double>::min());
}

Vector3d HullOracle::difference() const {
  const std::vector<Kernel::Point_3> a = cgal_points(points_A_);
  const std::vector<Kernel::Point_3> b = cgal_points(points_B_);
  const Distance distance(a.begin(), a.end(), b.begin(), b.end());
  // Homogeneous coordinates: the fourth divides the others.
  const auto p = distance.realizing_point_p_coordinates_begin();
  const auto q = distance.realizing_point_q_coordinates_begin();
  Vector3d result;
  for (int k = 0; k < 3; ++k)
    result[k] = CGAL::to_double(Exact(q[k] * p[3] - p[k] * q[3])) / CGAL::to_double(Exact(p[3] * q[3]));
  return result;
}

}  // namespace glissade::test_support

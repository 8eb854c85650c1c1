#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Geometry>

#include <glissade/reference/separating_axis.h>

namespace glissade::reference {
namespace {

using Eigen::Vector3d;

// Both triangles relative to one corner, so that rounding errors scale with their extent and not with their position.
class AxisTest {
 public:
  AxisTest(const CheckTriangle& a, const CheckTriangle& b)
      : a1_(a.p1 - a.p0), a2_(a.p2 - a.p0), b_{b.p0 - a.p0, b.p1 - a.p0, b.p2 - a.p0} {
    const double reach =
        std::max({a1_.lpNorm<1>(), a2_.lpNorm<1>(), b_[0].lpNorm<1>(), b_[1].lpNorm<1>(), b_[2].lpNorm<1>()});
    // A projection is three products and two sums of rounded differences: this is several times its error.
    uncertainty_ = 16.0 * std::numeric_limits<double>::epsilon() * reach;
  }

  bool separated_along(const Vector3d& axis) const {
    const double a1 = axis.dot(a1_);
    const double a2 = axis.dot(a2_);
    const double b0 = axis.dot(b_[0]);
    const double b1 = axis.dot(b_[1]);
    const double b2 = axis.dot(b_[2]);
    const double gap_above = std::min({b0, b1, b2}) - std::max({0.0, a1, a2});
    const double gap_below = std::min({0.0, a1, a2}) - std::max({b0, b1, b2});
    return std::max(gap_above, gap_below) > uncertainty_ * axis.lpNorm<1>();
  }

 private:
  Vector3d a1_;
  Vector3d a2_;
  std::array<Vector3d, 3> b_;
  double uncertainty_;
};

std::array<Vector3d, 3> edges_of(const CheckTriangle& t) {
  return {t.p1 - t.p0, t.p2 - t.p1, t.p0 - t.p2};
}

}  // namespace

bool separated(const CheckTriangle& a, const CheckTriangle& b) {
  const AxisTest test(a, b);
  const std::array<Vector3d, 3> edges_a = edges_of(a);
  const std::array<Vector3d, 3> edges_b = edges_of(b);
  const Vector3d normal_a = edges_a[0].cross(edges_a[1]);
  const Vector3d normal_b = edges_b[0].cross(edges_b[1]);
  if (test.separated_along(normal_a) || test.separated_along(normal_b)) return true;
  for (const Vector3d& edge_a : edges_a) {
    for (const Vector3d& edge_b : edges_b) {
      if (test.separated_along(edge_a.cross(edge_b))) return true;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (test.separated_along(normal_a.cross(edges_a[i])) || test.separated_along(normal_b.cross(edges_b[i])))
      return true;
  }
  return false;
}

}  // namespace glissade::reference

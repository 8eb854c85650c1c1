#include "quad_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace glissade::test_support {
namespace {

using geometry::TrianglePoints;

#if defined(__SIZEOF_FLOAT128__)
__extension__ using Quad = __float128;
#else
using Quad = long double;  // is quadruple precision where __float128 is missing, on 64-bit ARM
static_assert(std::numeric_limits<Quad>::digits >= 113);
#endif

template <typename Real>
struct Point {
  Real x, y, z;
};

template <typename Real>
using Corners = std::array<Point<Real>, 3>;

template <typename Real>
Point<Real> operator-(const Point<Real>& p, const Point<Real>& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}

// p + t · v.
template <typename Real>
Point<Real> along(const Point<Real>& p, Real t, const Point<Real>& v) {
  return {p.x + t * v.x, p.y + t * v.y, p.z + t * v.z};
}

template <typename Real>
Real dot(const Point<Real>& u, const Point<Real>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

template <typename Real>
Point<Real> cross(const Point<Real>& u, const Point<Real>& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

template <typename Real>
Point<Real> point(const Eigen::Vector3d& p) {
  return {static_cast<Real>(p.x()), static_cast<Real>(p.y()), static_cast<Real>(p.z())};
}

template <typename Real>
Corners<Real> corners(const geometry::TrianglePoints& t) {
  return {point<Real>(t[0]), point<Real>(t[1]), point<Real>(t[2])};
}

template <typename Real>
Real squared_to_segment(const Point<Real>& p, const Point<Real>& from, const Point<Real>& to) {
  const Point<Real> edge = to - from;
  const Real length = dot(edge, edge);
  const Real t = length > 0 ? std::clamp<Real>(dot(p - from, edge) / length, 0, 1) : Real(0);
  const Point<Real> gap = p - along(from, t, edge);
  return dot(gap, gap);
}

// Distance of the lines if their closest points lie inside both edges; otherwise `otherwise`.
template <typename Real>
Real squared_between_edges(const Point<Real>& p, const Point<Real>& p_end, const Point<Real>& q,
                           const Point<Real>& q_end, Real otherwise) {
  const Point<Real> u = p_end - p;
  const Point<Real> v = q_end - q;
  const Point<Real> normal = cross(u, v);
  const Real squared = dot(normal, normal);
  if (!(squared > 0)) return otherwise;
  const Real s = dot(cross(q - p, v), normal) / squared;
  const Real t = dot(cross(q - p, u), normal) / squared;
  if (s < 0 || s > 1 || t < 0 || t > 1) return otherwise;
  const Point<Real> gap = along(q, t, v) - along(p, s, u);
  return dot(gap, gap);
}

// Distance from the plane if the foot of the perpendicular lies inside the triangle; otherwise `otherwise`.
template <typename Real>
Real squared_to_face(const Point<Real>& p, const Corners<Real>& t, Real otherwise) {
  const Point<Real> u = t[1] - t[0];
  const Point<Real> v = t[2] - t[0];
  const Point<Real> normal = cross(u, v);
  const Real squared = dot(normal, normal);
  if (!(squared > 0)) return otherwise;
  const Point<Real> w = p - t[0];
  const Real a = dot(cross(w, v), normal) / squared;
  const Real b = dot(cross(u, w), normal) / squared;
  if (a < 0 || b < 0 || a + b > 1) return otherwise;
  const Point<Real> gap = along(along(t[0], a, u), b, v) - p;
  return dot(gap, gap);
}

template <typename Real>
Real squared_to_triangle(const Point<Real>& p, const Corners<Real>& t) {
  Real least = squared_to_segment(p, t[0], t[1]);
  least = std::min(least, squared_to_segment(p, t[1], t[2]));
  least = std::min(least, squared_to_segment(p, t[2], t[0]));
  return std::min(least, squared_to_face(p, t, least));
}

// All pairs of features that can hold the closest points. Each candidate is the distance of two points of the
// triangles, so rounding makes none too small.
template <typename Real>
Real squared_distance(const Corners<Real>& a, const Corners<Real>& b) {
  Real least = squared_to_triangle(a[0], b);
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, squared_to_triangle(a[i], b));
    least = std::min(least, squared_to_triangle(b[i], a));
    for (std::size_t j = 0; j < 3; ++j)
      least = std::min(least, squared_between_edges(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], least));
  }
  return least;
}

double root(Quad squared) {
  return static_cast<double>(std::sqrt(static_cast<long double>(squared)));
}

}  // namespace

double quad_distance(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b) {
  return root(squared_distance(corners<Quad>(a), corners<Quad>(b)));
}

double quad_distance(const Eigen::Vector3d& p, const geometry::TrianglePoints& triangle) {
  return root(squared_to_triangle(point<Quad>(p), corners<Quad>(triangle)));
}

double rough_distance(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b) {
  return static_cast<double>(std::sqrt(squared_distance(corners<long double>(a), corners<long double>(b))));
}

}  // namespace glissade::test_support

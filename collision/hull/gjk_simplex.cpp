#include "hull/gjk_simplex.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace glissade::collision {

using Eigen::Vector3d;

namespace {

// The faces of four points, each followed by the point that is not part of it.
constexpr std::array<std::array<int, 4>, 4> kFaces{{{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}};

// A triangle narrower than this, as the square of width over length, is a segment up to rounding.
constexpr double kNarrowest = 1e-30;

// Bound on the rounding error of a volume: six products of three coordinates each, with a dozen roundings.
double rounding_of_volume(const Vector3d& u, const Vector3d& v, const Vector3d& w) {
  return 32.0 * std::numeric_limits<double>::epsilon() * u.lpNorm<1>() * v.lpNorm<1>() * w.lpNorm<1>();
}

// The component of x perpendicular to u. Two steps are enough; a single one leaves a rounding error of x, which may be
// longer than the result.
Vector3d across(const Vector3d& x, const Vector3d& u, double u_u) {
  const Vector3d once = x - x.dot(u) / u_u * u;
  return once - once.dot(u) / u_u * u;
}

}  // namespace

bool GjkSimplex::has(std::int32_t corner_A, std::int32_t corner_B) const {
  for (int i = 0; i < count_; ++i) {
    if ((*this)[i].corner_A == corner_A && (*this)[i].corner_B == corner_B) return true;
  }
  return false;
}

bool GjkSimplex::encloses_origin() const {
  if (count_ < 4) return false;
  // The origin is inside if it lies on the same side of all four faces as the opposite points.
  int positive = 0;
  int negative = 0;
  for (const auto& face : kFaces) {
    const Vector3d& a = w(face[0]);
    const Vector3d& b = w(face[1]);
    const Vector3d& c = w(face[2]);
    const double volume = a.dot(b.cross(c));
    const double error = rounding_of_volume(a, b, c);
    positive += volume > error ? 1 : 0;
    negative += volume < -error ? 1 : 0;
  }
  return positive == 4 || negative == 4;
}

// Whether the origin certainly lies on that side of a face where the fourth point is.
bool GjkSimplex::surely_sees_no_origin(const Face& face) const {
  const Vector3d ab = w(face[1]) - w(face[0]);
  const Vector3d ac = w(face[2]) - w(face[0]);
  const Vector3d to_last = w(face[3]) - w(face[0]);
  const Vector3d n = ab.cross(ac);
  const double side_of_last = n.dot(to_last);
  if (std::abs(side_of_last) <= rounding_of_volume(ab, ac, to_last)) return false;
  return (side_of_last > 0.0) == (n.dot(w(face[0])) < 0.0);
}

GjkSimplex::Nearest GjkSimplex::nearest_of_segment(int a, int b) const {
  const Vector3d along = w(b) - w(a);
  const double length = along.squaredNorm();
  const double t = -w(a).dot(along);
  if (!(t > 0.0)) return {w(a), {a, 0, 0}, 1};
  if (t >= length) return {w(b), {b, 0, 0}, 1};
  return {across(w(a), along, length), {a, b, 0}, 2};
}

// Computed along the longest edge and perpendicular to it, where narrow triangles keep their precision: u is that edge,
// v the vector from its line to the third corner, q the vector from the origin to its line.
std::optional<Vector3d> GjkSimplex::nearest_inside(int a, int b, int c) const {
  const Vector3d u = w(b) - w(a);
  const double u_u = u.squaredNorm();
  const Vector3d v = across(w(c) - w(a), u, u_u);
  const double v_v = v.squaredNorm();
  if (!(v_v > kNarrowest * u_u)) return std::nullopt;
  const Vector3d q = across(w(a), u, u_u);
  const double along_v = -q.dot(v) / v_v;
  if (!(along_v > 0.0 && along_v < 1.0)) return std::nullopt;
  const double along_u = -w(a).dot(u) / u_u;
  const double along_u_of_c = (w(c) - w(a)).dot(u) / u_u;
  if (!(along_u > along_v * along_u_of_c && along_u < 1.0 - along_v * (1.0 - along_u_of_c))) return std::nullopt;
  return across(across(q, v, v_v), u, u_u);
}

GjkSimplex::Nearest GjkSimplex::nearest_of_triangle(int a, int b, int c) const {
  const double ab = (w(b) - w(a)).squaredNorm();
  const double bc = (w(c) - w(b)).squaredNorm();
  const double ca = (w(a) - w(c)).squaredNorm();
  std::optional<Vector3d> inside;
  if (ab >= bc && ab >= ca) {
    inside = nearest_inside(a, b, c);
  } else {
    inside = bc >= ca ? nearest_inside(b, c, a) : nearest_inside(c, a, b);
  }
  if (inside) return {*inside, {a, b, c}, 3};
  Nearest best = nearest_of_segment(a, b);
  for (const Nearest& other : {nearest_of_segment(b, c), nearest_of_segment(c, a)}) {
    if (other.point.squaredNorm() < best.point.squaredNorm()) best = other;
  }
  return best;
}

GjkSimplex::Nearest GjkSimplex::nearest_of_tetrahedron() const {
  // The nearest of the faces that see the origin from outside. If rounding hides which these are, the nearest of all.
  Nearest nearest{Vector3d::Constant(std::numeric_limits<double>::infinity()), {0, 0, 0}, 0};
  for (const bool any_face : {false, true}) {
    for (const auto& face : kFaces) {
      if (!any_face && surely_sees_no_origin(face)) continue;
      const Nearest of_face = nearest_of_triangle(face[0], face[1], face[2]);
      if (of_face.point.squaredNorm() < nearest.point.squaredNorm()) nearest = of_face;
    }
    if (nearest.count > 0) break;
  }
  return nearest;
}

Vector3d GjkSimplex::nearest_of_plane() const {
  GLISSADE_ASSERT(count_ == 3);
  const Vector3d n = (w(1) - w(0)).cross(w(2) - w(0));
  return n.dot(w(0)) / n.squaredNorm() * n;
}

Vector3d GjkSimplex::reduce_to_nearest() {
  GLISSADE_ASSERT(count_ > 0);
  Nearest nearest{w(0), {0, 0, 0}, 1};
  if (count_ == 2) nearest = nearest_of_segment(0, 1);
  if (count_ == 3) nearest = nearest_of_triangle(0, 1, 2);
  if (count_ == 4) nearest = nearest_of_tetrahedron();
  std::array<bool, 4> is_kept{};
  for (int i = 0; i < nearest.count; ++i)
    is_kept[static_cast<std::size_t>(nearest.of[static_cast<std::size_t>(i)])] = true;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (is_kept[i]) points_[kept++] = points_[i];
  }
  count_ = nearest.count;
  return nearest.point;
}

}  // namespace glissade::collision

#include "gjk_simplex.h"

#include <limits>

#include <Eigen/Geometry>

namespace glissade::collision {

using Eigen::Vector3d;

namespace {

// The faces of four points, each with the point that is not part of it last.
constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};

// Six products of three coordinates each and a dozen roundings.
double rounding_of_volume(const Vector3d& u, const Vector3d& v, const Vector3d& w) {
  return 32.0 * std::numeric_limits<double>::epsilon() * u.lpNorm<1>() * v.lpNorm<1>() * w.lpNorm<1>();
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
  // The origin sees all four faces from the side of the fourth point.
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

GjkSimplex::Nearest GjkSimplex::nearest_of_segment(int a, int b) const {
  const Vector3d along = w(b) - w(a);
  const double length = along.squaredNorm();
  const double t = -w(a).dot(along);
  if (!(t > 0.0)) return {w(a), {a, 0, 0}, 1};
  if (t >= length) return {w(b), {b, 0, 0}, 1};
  return {w(a) + t / length * along, {a, b, 0}, 2};
}

GjkSimplex::Nearest GjkSimplex::nearest_of_triangle(int a, int b, int c) const {
  const Vector3d ab = w(b) - w(a);
  const Vector3d ac = w(c) - w(a);
  const double d1 = -ab.dot(w(a));
  const double d2 = -ac.dot(w(a));
  const double d3 = -ab.dot(w(b));
  const double d4 = -ac.dot(w(b));
  const double d5 = -ab.dot(w(c));
  const double d6 = -ac.dot(w(c));
  const double of_a = d3 * d6 - d5 * d4;
  const double of_b = d5 * d2 - d1 * d6;
  const double of_c = d1 * d4 - d3 * d2;
  if (of_a > 0.0 && of_b > 0.0 && of_c > 0.0) {
    // Along the normal: coordinates within the triangle do not cancel there.
    const Vector3d n = ab.cross(ac);
    const double square = n.squaredNorm();
    if (square > 0.0) return {n.dot(w(a)) / square * n, {a, b, c}, 3};
  }
  Nearest best = nearest_of_segment(a, b);
  for (const Nearest& other : {nearest_of_segment(b, c), nearest_of_segment(c, a)}) {
    if (other.point.squaredNorm() < best.point.squaredNorm()) best = other;
  }
  return best;
}

Vector3d GjkSimplex::reduce_to_nearest() {
  Nearest nearest{w(0), {0, 0, 0}, 1};
  if (count_ == 2) nearest = nearest_of_segment(0, 1);
  if (count_ == 3) nearest = nearest_of_triangle(0, 1, 2);
  if (count_ == 4) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& face : kFaces) {
      const Vector3d n = (w(face[1]) - w(face[0])).cross(w(face[2]) - w(face[0]));
      const double side_of_origin = -n.dot(w(face[0]));
      const double side_of_last = n.dot(w(face[3]) - w(face[0]));
      if (side_of_origin * side_of_last > 0.0) continue;  // it does not see this face from outside
      const Nearest of_face = nearest_of_triangle(face[0], face[1], face[2]);
      if (of_face.point.squaredNorm() < least) {
        least = of_face.point.squaredNorm();
        nearest = of_face;
      }
    }
    if (least == std::numeric_limits<double>::infinity()) return Vector3d::Zero();
  }
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

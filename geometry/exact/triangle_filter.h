#pragma once

/// A filter for `triangles_intersect` in plain double precision with error bounds. It decides all but a few pairs, and
/// leaves nearly degenerate ones to exact arithmetic.

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::geometry {

enum class Verdict { kApart, kIntersect, kUnsure };

namespace filter {

/// The sign of a value known to within ± `error`; 0 if the sign is uncertain.
inline int certain_sign(double value, double error) {
  return (value > error) - (value < -error);
}

/// The corner that is alone on its side. The three signs must be certain, and not all equal.
inline std::size_t lone_corner(const std::array<int, 3>& side) {
  return side[1] == side[2] ? 0 : side[0] == side[2] ? 1 : 2;
}

}  // namespace filter

/// Whether two closed triangles share a point, or kUnsure. After P. Guigue and O. Devillers, "Fast and robust
/// triangle-triangle overlap test using orientation predicates", 2003, who prove that the last two orientations decide.
inline Verdict filtered_intersection(const TrianglePoints& a, const TrianglePoints& b) {
  using Eigen::Vector3d;
  // Coordinates relative to one corner, so that rounding errors scale with the extent of the pair and not with its
  // position.
  const std::array<Vector3d, 3> p{a[0] - b[0], a[1] - b[0], a[2] - b[0]};
  const std::array<Vector3d, 3> q{Vector3d::Zero(), b[1] - b[0], b[2] - b[0]};
  const double largest = std::max({p[0].cwiseAbs().maxCoeff(), p[1].cwiseAbs().maxCoeff(), p[2].cwiseAbs().maxCoeff(),
                                   q[1].cwiseAbs().maxCoeff(), q[2].cwiseAbs().maxCoeff()});
  // A determinant of three vectors is a sum of six products. Each is at most `largest`³ in the first step, where
  // vectors are rounded once, and eight times that in the second and third, where vectors are rounded twice. Each
  // factor, product and sum adds half an epsilon.
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double cube = largest * largest * largest;
  const double error = 32.0 * kEpsilon * cube;
  const double error_of_differences = 512.0 * kEpsilon * cube;

  const Vector3d normal_q = q[1].cross(q[2]);
  std::array<int, 3> side_p;
  for (std::size_t i = 0; i < 3; ++i)
    side_p[i] = filter::certain_sign(-normal_q.dot(p[i]), error);
  if (side_p[0] != 0 && side_p[0] == side_p[1] && side_p[0] == side_p[2]) return Verdict::kApart;

  const Vector3d normal_p = (p[1] - p[0]).cross(p[2] - p[0]);
  std::array<int, 3> side_q;
  for (std::size_t i = 0; i < 3; ++i)
    side_q[i] = filter::certain_sign(-normal_p.dot(q[i] - p[0]), error_of_differences);
  if (side_q[0] != 0 && side_q[0] == side_q[1] && side_q[0] == side_q[2]) return Verdict::kApart;
  if (side_p[0] * side_p[1] * side_p[2] * side_q[0] * side_q[1] * side_q[2] == 0) return Verdict::kUnsure;

  const std::size_t apex_p = filter::lone_corner(side_p);
  const std::size_t apex_q = filter::lone_corner(side_q);
  std::size_t left_p = (apex_p + 1) % 3;
  std::size_t right_p = (apex_p + 2) % 3;
  std::size_t left_q = (apex_q + 1) % 3;
  std::size_t right_q = (apex_q + 2) % 3;
  if (side_p[apex_p] < 0) std::swap(left_q, right_q);
  if (side_q[apex_q] < 0) std::swap(left_p, right_p);
  const Vector3d between = q[apex_q] - p[apex_p];
  const auto orientation = [&](std::size_t end_p, std::size_t end_q) {
    const Vector3d along_p = p[end_p] - p[apex_p];
    const Vector3d along_q = q[end_q] - p[apex_p];
    return filter::certain_sign(-along_p.cross(between).dot(along_q), error_of_differences);
  };
  const int left = orientation(left_p, left_q);
  const int right = orientation(right_p, right_q);
  if (left > 0 || right < 0) return Verdict::kApart;
  return left < 0 && right > 0 ? Verdict::kIntersect : Verdict::kUnsure;
}

}  // namespace glissade::geometry

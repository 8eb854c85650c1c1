#pragma once

/// Two triangles: the exact intersection test, and the distance with its closest points.

#include <array>

#include <Eigen/Core>

namespace glissade::geometry {

/// The three corners of a triangle, all in one frame.
using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// Whether the three points lie on one line, decided exactly: such a triangle has no area.
bool is_degenerate(const TrianglePoints& triangle);

/// Whether two closed triangles share a point, decided exactly for these coordinates; touching counts. Coplanar pairs,
/// shared edges and shared vertices are ordinary cases. `a` must not be degenerate. `b` may have become degenerate by
/// rounding when it was transformed; it is then the segment or point that is left.
bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b);

/// Distance in metres and the points where it is attained.
struct TriangleDistance {
  double distance;
  Eigen::Vector3d p_a;  ///< on the first triangle
  Eigen::Vector3d p_b;  ///< on the second
};

/// Closest points of two closed triangles. The distance is exactly 0 if and only if `triangles_intersect(a, b)`; both
/// points are then, up to rounding, one point of the intersection. Otherwise the distance is accurate to a few units in
/// the last place of the largest coordinate. `a` must not be degenerate; `b` may be, as in `triangles_intersect`.
TriangleDistance triangle_distance(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace glissade::geometry

#pragma once

/// Two triangles: exact intersection test; distance and closest points up to rounding.

#include <array>

#include <Eigen/Core>

namespace glissade::geometry {

/// The three corners of a triangle, all in one frame.
using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// Whether a triangle has no area because its three points lie on one line. Decided exactly.
bool is_degenerate(const TrianglePoints& triangle);

/// Whether two closed triangles share a point, decided exactly for these coordinates; touching counts. Coplanar pairs,
/// shared edges and shared vertices are ordinary cases. `a` must not be degenerate. `b` may be degenerate, for example
/// by rounding in a transformation; a degenerate `b` counts as the segment or point to which it has collapsed.
bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b);

/// The distance of two triangles in metres, and the two points at this distance.
struct TriangleDistance {
  double distance;
  Eigen::Vector3d p_a;  ///< on the first triangle
  Eigen::Vector3d p_b;  ///< on the second triangle
};

/// Closest points of two closed triangles. The distance is exactly 0 if and only if `triangles_intersect(a, b)`; both
/// points are then, up to rounding, one point of the intersection. Otherwise the distance is accurate to a few units in
/// the last place of the largest coordinate. `a` must not be degenerate; `b` may be, as in `triangles_intersect`.
TriangleDistance triangle_distance(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace glissade::geometry

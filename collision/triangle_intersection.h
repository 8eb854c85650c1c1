#pragma once

/// Exact predicates on triangles given by double-precision points.

#include <array>

#include <Eigen/Core>

namespace glissade::collision {

/// The three corners of a triangle, all in one frame.
using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// Whether the three points lie on one line, decided exactly: such a triangle has no area.
bool is_degenerate(const TrianglePoints& triangle);

/// Whether two closed triangles share a point, decided exactly for these coordinates; touching counts. Coplanar pairs,
/// shared edges and shared vertices are ordinary cases. `a` must have an area; `b` may have lost its own to rounding
/// when it was placed, and is then the segment or point that is left.
bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace glissade::collision

#pragma once

/// What CGAL says about two triangles, to compare our own predicates with. Exact, and independent of them.

#include <glissade/collision/triangle_intersection.h>

namespace glissade::test_support {

/// Whether two closed triangles share a point, decided exactly. The second may have lost its area: it then stands for
/// the segment or point that is left. Thread-safe.
bool cgal_intersect(const collision::TrianglePoints& a, const collision::TrianglePoints& b);

/// Whether the triangle has no area, decided exactly. Thread-safe.
bool cgal_is_degenerate(const collision::TrianglePoints& triangle);

/// Distance in rational arithmetic, rounded once at the end. Slow (a fraction of a millisecond).
double cgal_distance(const collision::TrianglePoints& a, const collision::TrianglePoints& b);
double cgal_distance(const Eigen::Vector3d& point, const collision::TrianglePoints& triangle);

}  // namespace glissade::test_support

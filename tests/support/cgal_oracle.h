#pragma once

/// CGAL's predicates on two triangles, an exact and independent reference for our own.

#include <glissade/geometry/triangle_pair.h>

namespace glissade::test_support {

/// Whether two closed triangles share a point, decided exactly. The second may be degenerate: it then stands
/// for its segment or point. Thread-safe.
bool cgal_intersect(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b);

/// Whether the triangle has no area, decided exactly. Thread-safe.
bool cgal_is_degenerate(const geometry::TrianglePoints& triangle);

/// Distance in rational arithmetic, rounded once at the end. Slow (a fraction of a millisecond).
double cgal_distance(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b);
double cgal_distance(const Eigen::Vector3d& point, const geometry::TrianglePoints& triangle);

}  // namespace glissade::test_support

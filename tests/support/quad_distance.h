#pragma once

/// The distance of two triangles over all pairs of their features in quadruple precision: slow, plain and independent
/// of `triangle_distance.h`.

#include <glissade/geometry/triangle_pair.h>

namespace glissade::test_support {

/// Distance of two closed triangles, rounded once. If they intersect, at most the distance of their boundaries. Either
/// may be degenerate. Takes some tens of microseconds.
double quad_distance(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b);

double quad_distance(const Eigen::Vector3d& point, const geometry::TrianglePoints& triangle);

/// The same with a relative error of about 1e-6, in a microsecond.
double rough_distance(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b);

}  // namespace glissade::test_support

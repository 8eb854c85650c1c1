#pragma once

/// The distance of two triangles and where it is attained.

#include <Eigen/Core>

#include <glissade/collision/triangle_intersection.h>

namespace glissade::collision {

/// Distance in metres and the points where it is attained.
struct TriangleDistance {
  double distance;
  Eigen::Vector3d p_a;  ///< on the first triangle
  Eigen::Vector3d p_b;  ///< on the second
};

/// Closest points of two closed triangles. Distance is exactly 0 if and only if `triangles_intersect(a, b)`; the points
/// are then (nearly) one point of the intersection. Otherwise accurate to a few units in the last place of the largest
/// coordinate. `a` must have an area; `b` may have lost its own.
TriangleDistance triangle_distance(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace glissade::collision

#pragma once

/// A triangle-triangle test in plain double arithmetic for `grid_check.h`. It shares no code with the exact predicates,
/// so that a comparison of both reveals mistakes.

#include <Eigen/Core>

namespace glissade::reference {

/// The corners of a triangle.
struct CheckTriangle {
  Eigen::Vector3d p0;
  Eigen::Vector3d p1;
  Eigen::Vector3d p2;
};

/// Whether some axis certainly separates the two triangles. The axes are the normals, the cross products of edges and,
/// for coplanar triangles, the cross products of edges with normals. False if the gap is within rounding errors (about
/// 1e-14 of the triangles' extent). So a caller that treats "not separated" as a collision misses no collision.
bool separated(const CheckTriangle& a, const CheckTriangle& b);

}  // namespace glissade::reference

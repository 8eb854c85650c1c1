#pragma once

/// A triangle-triangle test in plain double arithmetic for `grid_check.h`. The test shares no code with the exact
/// predicates, so that a comparison of the two reveals mistakes.

#include <Eigen/Core>

namespace glissade::reference {

/// The corners of a triangle.
struct CheckTriangle {
  Eigen::Vector3d p0;
  Eigen::Vector3d p1;
  Eigen::Vector3d p2;
};

/// Whether some axis certainly separates the two triangles. The axes are the normals, the cross products of edges and,
/// for coplanar triangles, the cross products of edges with normals. Returns false if the gap is within rounding errors
/// (about 1e-14 of the triangles' extent). So a caller that treats false as a collision misses no collision.
bool separated(const CheckTriangle& a, const CheckTriangle& b);

}  // namespace glissade::reference

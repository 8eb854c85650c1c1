#pragma once

/// A triangle-triangle test in plain double arithmetic for `grid_check.h`. It shares no code with the exact predicates,
/// so that comparison reveals a mistake in either.

#include <Eigen/Core>

namespace glissade::reference {

/// The corners of a triangle.
struct CheckTriangle {
  Eigen::Vector3d p0;
  Eigen::Vector3d p1;
  Eigen::Vector3d p2;
};

/// Whether some axis (the normals, the cross products of edges, and those of edges with normals for coplanar triangles)
/// certainly separates the two triangles. False where the gap is lost in rounding (about 1e-14 of their extent): a
/// caller that treats "not separated" as a collision never misses one.
bool separated(const CheckTriangle& a, const CheckTriangle& b);

}  // namespace glissade::reference

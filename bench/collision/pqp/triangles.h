#pragma once

/// The leaves of the published method of PQP: overlap and distance of two triangles, in single precision.

#include "vectors.h"

namespace glissade::bench::pqp {

/// Corners, one in each lane; the fourth repeats the first.
struct Corners {
  Floats4 x;
  Floats4 y;
  Floats4 z;
};

inline Corners corners(const TriangleNode& triangle) {
  return {load(triangle.x), load(triangle.y), load(triangle.z)};
}

/// The corners of a triangle of B in the frame of A.
inline Corners corners_in_A(const Pose& X_AB, const TriangleNode& triangle) {
  const Corners c = corners(triangle);
  const auto coordinate = [&](const float(&row)[4]) { return c.x * row[0] + c.y * row[1] + c.z * row[2] + row[3]; };
  return {coordinate(X_AB.rows[0]), coordinate(X_AB.rows[1]), coordinate(X_AB.rows[2])};
}

/// Whether two triangles in one frame have a point in common.
bool overlap(const Corners& a, const Corners& b);

/// Squared distance of two triangles in one frame, 0 where they overlap; any number of at least `limit` if it is not
/// below `limit`.
float squared_distance_below(float limit, const Corners& a, const Corners& b);

}  // namespace glissade::bench::pqp

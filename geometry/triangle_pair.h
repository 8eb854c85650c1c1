#pragma once

/// Functions of pairs of triangles: an exact intersection test, the distance and closest points (up to rounding) of one
/// or eight pairs, and the features on which closest points lie.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>

namespace glissade::geometry {

/// The three corners of a triangle, all in one frame.
using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// Whether the three points of a triangle lie on one line, so that it has no area. The test is exact.
GLISSADE_EXPORT bool is_degenerate(const TrianglePoints& triangle);

/// Whether two closed triangles share a point, as triangles that touch do. The test is exact for the given coordinates.
/// Coplanar pairs, shared edges and shared vertices need no special treatment. `a` must not be degenerate. `b` may be
/// degenerate, for example by rounding in a transformation. A degenerate `b` counts as the segment or point that its
/// corners span.
GLISSADE_EXPORT bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b);

/// The distance of two triangles in metres, and the two points at this distance.
struct TriangleDistance {
  double distance;
  Eigen::Vector3d p_a;  ///< on the first triangle
  Eigen::Vector3d p_b;  ///< on the second triangle
};

/// Closest points of two closed triangles. The distance is exactly 0 if and only if `triangles_intersect(a, b)`. If the
/// distance is 0, both points are the same point of the intersection, up to rounding. Otherwise the distance is
/// accurate to a few units in the last place of the largest coordinate. `a` must not be degenerate. `b` may be
/// degenerate, as in `triangles_intersect`.
GLISSADE_EXPORT TriangleDistance triangle_distance(const TrianglePoints& a, const TrianglePoints& b);

inline constexpr std::size_t kPairsToMeasure = 8;

/// One vector (metres) for each pair, indexed by [axis][pair].
using VectorsOfPairs = std::array<std::array<double, kPairsToMeasure>, 3>;
/// One triangle (metres) for each pair, indexed by [corner][axis][pair].
using TrianglesOfPairs = std::array<VectorsOfPairs, 3>;

inline void put_triangle(const TrianglePoints& triangle, std::size_t pair, TrianglesOfPairs& triangles) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      triangles[corner][axis][pair] = triangle[corner][static_cast<Eigen::Index>(axis)];
  }
}
inline Eigen::Vector3d vector_of_pair(const VectorsOfPairs& vectors, std::size_t pair) {
  return {vectors[0][pair], vectors[1][pair], vectors[2][pair]};
}

/// Pairs of triangles in one frame. Unused entries may have any values.
struct alignas(64) TrianglesToMeasure {
  TrianglesOfPairs a;
  TrianglesOfPairs b;
};

/// The closest points of each pair of triangles. The points lie on two edges, or are a corner and a point of a face.
struct alignas(64) ClosestPoints {
  std::array<double, kPairsToMeasure> squared_distance;
  std::array<double, kPairsToMeasure> is_apart;  ///< 1 where the triangles certainly do not intersect, else 0
  VectorsOfPairs p_a;
  VectorsOfPairs p_b;
};

/// For each pair that does not intersect, finds the squared distance and the closest points, bit-identical to
/// `triangle_distance`. For other pairs, `is_apart` is 0, and the points are meaningless. Uses vector code.
/// Thread-safe.
GLISSADE_EXPORT void find_closest_points(const TrianglesToMeasure& triangles, ClosestPoints& closest);

/// The kind of feature on which a point of a triangle lies.
enum class Region : std::uint8_t { kFace, kEdge, kVertex };

struct ClosestOnTriangle {
  Eigen::Vector3d point;
  Region region;
  int index;  ///< number of the vertex, or of the edge's first corner; 0 for a face
};

/// The point of a triangle closest to x, found by the triangle's Voronoi regions.
inline ClosestOnTriangle closest_on_triangle(const Eigen::Vector3d& x, const TrianglePoints& t) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool outside_any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = t[i];
    const Eigen::Vector3d along = t[(i + 1) % 3] - a;
    const Eigen::Vector3d to_x = x - a;
    if (normal.cross(along).dot(to_x) >= 0.0) continue;
    outside_any = true;
    const double s = along.dot(to_x) / along.squaredNorm();
    if (s > 0.0 && s < 1.0) return {a + s * along, Region::kEdge, static_cast<int>(i)};
  }
  if (!outside_any) {
    return {x - normal * (normal.dot(x - t[0]) / normal.squaredNorm()), Region::kFace, 0};
  }
  int nearest = 0;
  for (int i = 1; i < 3; ++i) {
    if ((x - t[static_cast<std::size_t>(i)]).squaredNorm() < (x - t[static_cast<std::size_t>(nearest)]).squaredNorm())
      nearest = i;
  }
  return {t[static_cast<std::size_t>(nearest)], Region::kVertex, nearest};
}

/// Closest points `p` and `q` of the lines through two segments. `along_p` and `along_q` are positions along the
/// segments: 0 at the first end and 1 at the second end.
struct SegmentPoints {
  Eigen::Vector3d p;
  Eigen::Vector3d q;
  double along_p;
  double along_q;
};

/// Finds the closest points of the lines through two segments. Returns false if the lines are parallel.
inline bool closest_points_of_lines(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                                    const Eigen::Vector3d& q1, SegmentPoints& closest) {
  constexpr double kParallelSineSquared = 1e-12;
  const Eigen::Vector3d d = p1 - p0;
  const Eigen::Vector3d e = q1 - q0;
  const Eigen::Vector3d w = p0 - q0;
  const double dd = d.squaredNorm();
  const double ee = e.squaredNorm();
  const double de = d.dot(e);
  const double determinant = dd * ee - de * de;
  if (determinant <= kParallelSineSquared * dd * ee) return false;
  const double s = (de * e.dot(w) - ee * d.dot(w)) / determinant;
  const double t = (dd * e.dot(w) - de * d.dot(w)) / determinant;
  closest = {p0 + s * d, q0 + t * e, s, t};
  return true;
}

/// Finds the closest points of two segments. Returns false if the segments are parallel, or if a closest point of the
/// lines is not strictly inside its segment.
inline bool interior_closest_points(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                                    const Eigen::Vector3d& q1, SegmentPoints& closest) {
  if (!closest_points_of_lines(p0, p1, q0, q1, closest)) return false;
  return closest.along_p > 0.0 && closest.along_p < 1.0 && closest.along_q > 0.0 && closest.along_q < 1.0;
}

}  // namespace glissade::geometry

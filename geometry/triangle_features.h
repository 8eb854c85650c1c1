#pragma once

/// Closest points of triangle features, with the feature on which each point lies.

#include <algorithm>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::geometry {

/// The kind of feature on which a point of a triangle lies.
enum class Region : std::uint8_t { kFace, kEdge, kVertex };

struct ClosestOnTriangle {
  Eigen::Vector3d point;
  Region region;
  int index;  ///< number of the edge (joins corners index and index + 1) or of the vertex
};

/// The point of a triangle closest to x, by the triangle's Voronoi regions.
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

/// Closest points of the lines through two segments, and their positions along the segments: 0 at the first end, 1 at
/// the second.
struct SegmentPoints {
  Eigen::Vector3d p;
  Eigen::Vector3d q;
  double along_p;
  double along_q;
};

/// The closest points of the lines through two segments. Returns false where these are parallel.
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

/// The closest points of two segments if both lie strictly inside them and the segments are not parallel.
/// Returns false otherwise.
inline bool interior_closest_points(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                                    const Eigen::Vector3d& q1, SegmentPoints& closest) {
  if (!closest_points_of_lines(p0, p1, q0, q1, closest)) return false;
  return closest.along_p > 0.0 && closest.along_p < 1.0 && closest.along_q > 0.0 && closest.along_q < 1.0;
}

}  // namespace glissade::geometry

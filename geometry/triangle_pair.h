#pragma once

/// Two triangles: exact intersection test; distance and closest points up to rounding, of one pair or eight at once.

#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace glissade::geometry {

/// The three corners of a triangle, all in one frame.
using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// Whether a triangle has no area because its three points lie on one line. Decided exactly.
bool is_degenerate(const TrianglePoints& triangle);

/// Whether two closed triangles share a point, decided exactly for these coordinates; touching counts. Coplanar pairs,
/// shared edges and shared vertices are ordinary cases. `a` must not be degenerate. `b` may be degenerate, for example
/// by rounding in a transformation; a degenerate `b` counts as the segment or point to which it has collapsed.
bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b);

/// The distance of two triangles in metres, and the two points at this distance.
struct TriangleDistance {
  double distance;
  Eigen::Vector3d p_a;  ///< on the first triangle
  Eigen::Vector3d p_b;  ///< on the second triangle
};

/// Closest points of two closed triangles. The distance is exactly 0 if and only if `triangles_intersect(a, b)`; both
/// points are then, up to rounding, one point of the intersection. Otherwise the distance is accurate to a few units in
/// the last place of the largest coordinate. `a` must not be degenerate; `b` may be, as in `triangles_intersect`.
TriangleDistance triangle_distance(const TrianglePoints& a, const TrianglePoints& b);

inline constexpr std::size_t kPairsToMeasure = 8;

/// A vector of each pair: [axis][pair], metres.
using VectorsOfPairs = std::array<std::array<double, kPairsToMeasure>, 3>;
/// A triangle of each pair: [corner][axis][pair], metres.
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

/// Pairs of triangles in one frame. Entries that are not used may have any values.
struct alignas(64) TrianglesToMeasure {
  TrianglesOfPairs a;
  TrianglesOfPairs b;
};

/// The closest points of two edges, or of a corner and a face.
struct alignas(64) ClosestPoints {
  std::array<double, kPairsToMeasure> squared_distance;
  std::array<double, kPairsToMeasure> is_apart;  ///< 1 where the triangles certainly do not intersect, else 0
  VectorsOfPairs p_a;
  VectorsOfPairs p_b;
};

/// The same points as `triangle_distance`, bit for bit, and the square of their distance, for pairs that do not
/// intersect. Others are not said to be apart, and have points of no meaning. In vector code. Thread-safe.
void find_closest_points(const TrianglesToMeasure& triangles, ClosestPoints& closest);

}  // namespace glissade::geometry

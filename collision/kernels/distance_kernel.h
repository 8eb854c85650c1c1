#pragma once

/// The vector code for distances of triangles: eight pairs at once, with the same bits as one pair at a time.

#include <array>
#include <cstddef>

namespace glissade::collision {

inline constexpr std::size_t kPairsToMeasure = 8;

/// A vector of each pair: [axis][pair], metres.
using VectorsOfPairs = std::array<std::array<double, kPairsToMeasure>, 3>;

/// The corners of triangles in one frame: [corner][axis][pair]. Entries that are not used may have any values.
struct alignas(64) TrianglesToMeasure {
  std::array<VectorsOfPairs, 3> a;
  std::array<VectorsOfPairs, 3> b;
};

/// The closest points of two edges, or of a corner and a face.
struct alignas(64) ClosestPoints {
  std::array<double, kPairsToMeasure> squared_distance;
  VectorsOfPairs p_a;
  VectorsOfPairs p_b;
};

/// The same points as `geometry::triangle_distance`, and the square of their distance, for triangles that do not
/// intersect. Thread-safe.
void find_closest_points(const TrianglesToMeasure& triangles, ClosestPoints& closest);

}  // namespace glissade::collision

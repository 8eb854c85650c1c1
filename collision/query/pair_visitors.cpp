#include "query/pair_visitors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::collision {
namespace {

/// Fewer pairs are measured faster one by one.
constexpr std::size_t kWorthVectors = 3;

void put_corners(const geometry::TrianglePoints& points, std::size_t pair, std::array<VectorsOfPairs, 3>& corners) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[c][axis][pair] = points[c][static_cast<Eigen::Index>(axis)];
  }
}

Eigen::Vector3d point_of_pair(const VectorsOfPairs& vectors, std::size_t pair) {
  return {vectors[0][pair], vectors[1][pair], vectors[2][pair]};
}

}  // namespace

template <>
void PairCollector<ClosePair>::measure_waiting() {
  const std::size_t count = std::exchange(waiting_count_, 0);
  if (count < kWorthVectors) {
    for (std::size_t i = 0; i < count; ++i)
      note(waiting_[i], false);
    return;
  }
  std::array<geometry::TrianglePoints, kPairsToMeasure> a;
  std::array<geometry::TrianglePoints, kPairsToMeasure> b;
  TrianglesToMeasure triangles{};
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = placed_.points_A(waiting_[i]);
    b[i] = placed_.points_B(waiting_[i]);
    put_corners(a[i], i, triangles.a);
    put_corners(b[i], i, triangles.b);
  }
  ClosestPoints closest;
  find_closest_points(triangles, closest);
  for (std::size_t i = 0; i < count; ++i) {
    if (geometry::triangles_intersect(a[i], b[i])) {
      note(waiting_[i], true);
      continue;
    }
    // As in `geometry::triangle_distance`.
    const double distance = std::max(std::sqrt(closest.squared_distance[i]), std::numeric_limits<double>::min());
    if (distance > tolerance_) continue;
    pairs_.push_back({waiting_[i], distance, point_of_pair(closest.p_a, i), point_of_pair(closest.p_b, i)});
  }
}

}  // namespace glissade::collision

#include "query/pair_visitors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glissade::collision {
namespace {

/// Fewer pairs are measured faster one by one.
constexpr std::size_t kWorthVectors = 3;

}  // namespace

template <>
void PairCollector<ClosePair>::measure_waiting() {
  const std::size_t count = std::exchange(waiting_count_, 0);
  if (count < kWorthVectors) {
    for (std::size_t i = 0; i < count; ++i)
      note(waiting_[i], false);
    return;
  }
  std::array<geometry::TrianglePoints, geometry::kPairsToMeasure> a;
  std::array<geometry::TrianglePoints, geometry::kPairsToMeasure> b;
  geometry::TrianglesToMeasure triangles{};
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = placed_.points_A(waiting_[i]);
    b[i] = placed_.points_B(waiting_[i]);
    geometry::put_triangle(a[i], i, triangles.a);
    geometry::put_triangle(b[i], i, triangles.b);
  }
  geometry::ClosestPoints closest;
  geometry::find_closest_points(triangles, closest);
  for (std::size_t i = 0; i < count; ++i) {
    if (closest.is_apart[i] == 0.0 && geometry::triangles_intersect(a[i], b[i])) {
      note(waiting_[i], true);
      continue;
    }
    // As in `geometry::triangle_distance`.
    const double distance = std::max(std::sqrt(closest.squared_distance[i]), std::numeric_limits<double>::min());
    if (distance > tolerance_) continue;
    pairs_.push_back(
        {waiting_[i], distance, geometry::vector_of_pair(closest.p_a, i), geometry::vector_of_pair(closest.p_b, i)});
  }
}

}  // namespace glissade::collision

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

std::span<const ClosePair> WaitingPairs::measure(const PlacedTrees& placed) {
  const std::size_t count = std::exchange(count_, 0);
  const std::span<const ClosePair> measured = std::span(measured_).first(count);
  if (count < kWorthVectors) {
    for (std::size_t i = 0; i < count; ++i) {
      const geometry::TriangleDistance closest =
          geometry::triangle_distance(placed.points_A(waiting_[i]), placed.points_B(waiting_[i]));
      measured_[i] = {waiting_[i], closest.distance, closest.p_a, closest.p_b};
    }
    return measured;
  }
  std::array<geometry::TrianglePoints, geometry::kPairsToMeasure> a;
  std::array<geometry::TrianglePoints, geometry::kPairsToMeasure> b;
  geometry::TrianglesToMeasure triangles{};
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = placed.points_A(waiting_[i]);
    b[i] = placed.points_B(waiting_[i]);
    geometry::put_triangle(a[i], i, triangles.a);
    geometry::put_triangle(b[i], i, triangles.b);
  }
  geometry::ClosestPoints closest;
  geometry::find_closest_points(triangles, closest);
  for (std::size_t i = 0; i < count; ++i) {
    if (closest.is_apart[i] == 0.0 && geometry::triangles_intersect(a[i], b[i])) {
      measured_[i] = {waiting_[i], 0.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
      continue;
    }
    // As in `geometry::triangle_distance`.
    const double distance = std::max(std::sqrt(closest.squared_distance[i]), std::numeric_limits<double>::min());
    measured_[i] = {waiting_[i], distance, geometry::vector_of_pair(closest.p_a, i),
                    geometry::vector_of_pair(closest.p_b, i)};
  }
  return measured;
}

}  // namespace glissade::collision

#include "mesh_oracle.h"

#include <algorithm>

#include <glissade/geometry/triangle_pair.h>

#include "cgal_oracle.h"
#include "triangle_points.h"

namespace glissade::test_support {

using collision::ClosePair;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using geometry::TrianglePoints;

namespace {

double radius_of(const geometry::TriangleMesh& mesh) {
  double radius = 0.0;
  for (const Vector3d& vertex : mesh.vertices)
    radius = std::max(radius, vertex.norm());
  return radius;
}

}  // namespace

MeshOracle::MeshOracle(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B)
    : mesh_A_(mesh_A), mesh_B_(mesh_B), radius_A_(radius_of(mesh_A)), radius_B_(radius_of(mesh_B)) {
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh_A_.triangles.size()); ++i) {
    if (cgal_is_degenerate(points_of(mesh_A_, i))) continue;
    triangles_A_.push_back(boxed(points_of(mesh_A_, i), i));
    low_A_ = low_A_.min(triangles_A_.back().low);
    high_A_ = high_A_.max(triangles_A_.back().high);
    widest_A_ = std::max(widest_A_, triangles_A_.back().high.x() - triangles_A_.back().low.x());
  }
  std::sort(triangles_A_.begin(), triangles_A_.end(),
            [](const BoxedTriangle& u, const BoxedTriangle& v) { return u.low.x() < v.low.x(); });
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh_B_.triangles.size()); ++i) {
    if (!cgal_is_degenerate(points_of(mesh_B_, i))) triangles_B_.push_back(i);
  }
}

MeshOracle::BoxedTriangle MeshOracle::boxed(const geometry::TrianglePoints& points, std::int32_t index) {
  return {points, points[0].cwiseMin(points[1]).cwiseMin(points[2]), points[0].cwiseMax(points[1]).cwiseMax(points[2]),
          index};
}

geometry::TrianglePoints MeshOracle::points_A(std::int32_t triangle) const {
  return points_of(mesh_A_, triangle);
}

geometry::TrianglePoints MeshOracle::points_B(std::int32_t triangle, const Isometry3d& X_AB) const {
  return points_of(mesh_B_, triangle, X_AB);
}

bool MeshOracle::traverse_near(const Isometry3d& X_AB, double distance, const Visit& visit) const {
  // Slightly more than required, so that rounding of the boxes loses no pair.
  const double reach = distance * 1.000001;
  for (const std::int32_t i : triangles_B_) {
    const BoxedTriangle b = boxed(points_B(i, X_AB), i);
    if ((b.low > high_A_ + reach).any() || (b.high < low_A_ - reach).any()) continue;
    const double first_x = b.low.x() - reach - 1.000001 * widest_A_;
    auto a = std::lower_bound(triangles_A_.begin(), triangles_A_.end(), first_x,
                              [](const BoxedTriangle& t, double x) { return t.low.x() < x; });
    for (; a != triangles_A_.end() && a->low.x() <= b.high.x() + reach; ++a) {
      const bool near = (a->low <= b.high + reach).all() && (b.low <= a->high + reach).all();
      if (near && visit(*a, b)) return true;
    }
  }
  return false;
}

bool MeshOracle::intersects(const Isometry3d& X_AB) const {
  return traverse_near(
      X_AB, 0.0, [](const BoxedTriangle& a, const BoxedTriangle& b) { return cgal_intersect(a.points, b.points); });
}

std::vector<collision::TrianglePair> MeshOracle::intersecting_pairs(const Isometry3d& X_AB) const {
  std::vector<collision::TrianglePair> pairs;
  traverse_near(X_AB, 0.0, [&](const BoxedTriangle& a, const BoxedTriangle& b) {
    if (cgal_intersect(a.points, b.points)) pairs.push_back({a.index, b.index});
    return false;
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<ClosePair> MeshOracle::pairs_within(const Isometry3d& X_AB, double distance) const {
  std::vector<ClosePair> pairs;
  traverse_near(X_AB, distance, [&](const BoxedTriangle& a, const BoxedTriangle& b) {
    const geometry::TriangleDistance closest = geometry::triangle_distance(a.points, b.points);
    if (closest.distance <= distance) pairs.push_back({{a.index, b.index}, closest.distance, closest.p_a, closest.p_b});
    return false;
  });
  std::sort(pairs.begin(), pairs.end(),
            [](const ClosePair& u, const ClosePair& v) { return u.triangles < v.triangles; });
  return pairs;
}

}  // namespace glissade::test_support

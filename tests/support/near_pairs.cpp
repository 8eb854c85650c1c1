#include "near_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "cgal_oracle.h"
#include "quad_distance.h"
#include "triangle_points.h"

namespace glissade::test_support {

using collision::ClosePair;
using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using geometry::TriangleMesh;
using geometry::TrianglePoints;

namespace {

constexpr double kRounding = std::numeric_limits<double>::epsilon();

std::vector<std::int32_t> triangles_with_area(const geometry::TriangleMesh& mesh) {
  std::vector<std::int32_t> result;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.triangles.size()); ++i) {
    if (!cgal_is_degenerate(points_of(mesh, i))) result.push_back(i);
  }
  return result;
}

AlignedBox3d box_of(const geometry::TrianglePoints& points) {
  AlignedBox3d box(points[0]);
  return box.extend(points[1]).extend(points[2]);
}

double extent_of(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b) {
  return box_of(a).merged(box_of(b)).diagonal().norm();
}

double largest_coordinate(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b) {
  const AlignedBox3d box = box_of(a).merged(box_of(b));
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

void raise(std::atomic<double>& worst, double value) {
  double current = worst;
  while (value > current && !worst.compare_exchange_weak(current, value)) {
  }
}

}  // namespace

std::string NearPair::text() const {
  char line[120];
  std::snprintf(line, sizeof(line), "%d-%d at %.17g", triangles.triangle_A, triangles.triangle_B, distance);
  return line;
}

void DistanceErrors::add(double error, double distance, double extent) {
  if (distance > 1e-6 * extent) raise(worst_relative_, error / distance);
  raise(worst_of_extent_, error / (kRounding * extent));
}

void DistanceErrors::print() const {
  std::printf(
      "largest error of a distance: %.2g of it where it is above a millionth of the extent of the pair,\n"
      "  %.1f rounding units of the extent anywhere\n",
      worst_relative_.load(), worst_of_extent_.load());
}

NearPairs::NearPairs(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B)
    : mesh_A_(mesh_A),
      mesh_B_(mesh_B),
      triangles_A_(triangles_with_area(mesh_A)),
      triangles_B_(triangles_with_area(mesh_B)) {}

geometry::TrianglePoints NearPairs::points_A(std::int32_t triangle) const {
  return points_of(mesh_A_, triangle);
}

geometry::TrianglePoints NearPairs::points_B(std::int32_t triangle, const Isometry3d& X_AB) const {
  return points_of(mesh_B_, triangle, X_AB);
}

std::vector<NearPair> NearPairs::within(const Isometry3d& X_AB, double limit) const {
  std::vector<std::pair<geometry::TrianglePoints, AlignedBox3d>> placed_B;
  for (const std::int32_t j : triangles_B_) {
    const geometry::TrianglePoints points = points_B(j, X_AB);
    placed_B.emplace_back(points, box_of(points));
  }
  std::vector<NearPair> result;
  for (const std::int32_t i : triangles_A_) {
    const geometry::TrianglePoints a = points_A(i);
    const AlignedBox3d box_a = box_of(a);
    for (std::size_t j = 0; j < placed_B.size(); ++j) {
      const auto& [b, box_b] = placed_B[j];
      // More than required, so that no rounding loses a pair.
      const double reach = 1.001 * limit + 1e-9 * (box_a.merged(box_b)).diagonal().norm();
      if (box_a.exteriorDistance(box_b) > reach) continue;
      double distance = 0.0;
      if (!box_a.intersects(box_b) || !cgal_intersect(a, b)) {
        if (rough_distance(a, b) > reach) continue;
        // They are apart, even where quadruple precision loses the gap.
        distance = std::max(quad_distance(a, b), std::numeric_limits<double>::min());
      }
      const double doubt = 1e-12 * distance + 128.0 * kRounding * extent_of(a, b);
      result.push_back({{i, triangles_B_[j]}, distance, doubt});
    }
  }
  return result;
}

std::string NearPairs::fault_of(const ClosePair& actual, const NearPair& expected, const Isometry3d& X_AB,
                                DistanceErrors& errors) const {
  const geometry::TrianglePoints a = points_A(expected.triangles.triangle_A);
  const geometry::TrianglePoints b = points_B(expected.triangles.triangle_B, X_AB);
  const double error = std::abs(actual.distance - expected.distance);
  errors.add(error, expected.distance, extent_of(a, b));
  if (!(error <= expected.doubt)) return "distance is wrong: " + expected.text();
  if ((actual.distance == 0.0) != (expected.distance == 0.0)) return "a gap is lost or invented: " + expected.text();
  const double tolerance = 64.0 * kRounding * largest_coordinate(a, b);
  if (!(quad_distance(actual.p_A, a) <= tolerance)) return "p_A is not on triangle A: " + expected.text();
  if (!(quad_distance(actual.p_B, b) <= tolerance)) return "p_B is not on triangle B: " + expected.text();
  const double apart = (actual.p_A - actual.p_B).norm();
  // If a needle intersects a face flush with it, a common point is accurate to the width of the needle only.
  const double slack = expected.distance > 0.0 ? 1e-12 * expected.distance : 1e-8 * extent_of(a, b);
  if (!(std::abs(apart - expected.distance) <= slack + tolerance)) return "points are not closest: " + expected.text();
  return "";
}

}  // namespace glissade::test_support

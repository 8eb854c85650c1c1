#include "io/polygon_triangulation.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace glissade::geometry {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The polygon projected along the axis nearest to its normal, in counter-clockwise order. The normal is Newell's,
/// which also holds for concave and bent polygons.
std::vector<Eigen::Vector2d> flattened(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    normal += (points[i] - points[0]).cross(points[(i + 1) % points.size()] - points[0]);
  }
  Eigen::Index axis = 2;
  normal.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index u = (axis + 1) % 3;
  const Eigen::Index v = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& point : points) {
    flat.emplace_back(point[u], sign * point[v]);
  }
  return flat;
}

/// Whether the corner at `position` of the remaining polygon can be cut off: it is convex, and its triangle contains no
/// other corner.
bool is_ear(const std::vector<Eigen::Vector2d>& flat, const std::vector<std::size_t>& remaining, std::size_t position) {
  const std::size_t n = remaining.size();
  const Eigen::Vector2d& a = flat[remaining[(position + n - 1) % n]];
  const Eigen::Vector2d& b = flat[remaining[position]];
  const Eigen::Vector2d& c = flat[remaining[(position + 1) % n]];
  if (cross(a, b, c) <= 0) return false;
  return std::none_of(remaining.begin(), remaining.end(), [&](std::size_t other) {
    const Eigen::Vector2d& p = flat[other];
    const bool is_corner = p == a || p == b || p == c;
    return !is_corner && cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
  });
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulated(std::span<const Eigen::Vector3d> points) {
  std::vector<std::size_t> remaining;
  for (std::size_t i = 0; i < points.size(); ++i) {
    remaining.push_back(i);
  }
  std::vector<std::array<std::size_t, 3>> triangles;
  if (remaining.size() == 3) return {{0, 1, 2}};
  const std::vector<Eigen::Vector2d> flat = flattened(points);
  std::size_t position = 0;
  bool has_ears = true;
  while (remaining.size() > 2) {
    const std::size_t n = remaining.size();
    std::size_t tried = 0;
    while (has_ears && tried < n && !is_ear(flat, remaining, (position + tried) % n)) {
      ++tried;
    }
    // If no corner is an ear, the polygon crosses itself or its rest has no area: cut off any corner from now on.
    has_ears = has_ears && tried < n;
    if (has_ears) position = (position + tried) % n;
    triangles.push_back({remaining[(position + n - 1) % n], remaining[position], remaining[(position + 1) % n]});
    remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(position));
    // Continuing two corners farther, rather than next to the cut, avoids fans of slivers.
    position = (position + 1) % remaining.size();
  }
  return triangles;
}

void add_polygon(const MeshFile& file, std::span<const std::int32_t> corners, TriangleSoup& soup) {
  constexpr std::size_t kMostTriangles = std::numeric_limits<std::int32_t>::max();
  std::vector<Triangle>& triangles = soup.mesh.triangles;
  if (triangles.size() + corners.size() - 2 > kMostTriangles) {
    reject(file.path(), "the file has more than " + std::to_string(kMostTriangles) + " triangles");
  }
  if (corners.size() == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  ++soup.polygons_triangulated;
  std::vector<Eigen::Vector3d> points;
  for (const std::int32_t corner : corners) {
    points.push_back(soup.mesh.vertices[static_cast<std::size_t>(corner)]);
  }
  for (const auto& [a, b, c] : triangulated(points)) {
    triangles.push_back({corners[a], corners[b], corners[c]});
  }
}

}  // namespace glissade::geometry

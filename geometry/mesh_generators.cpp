#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glissade/base/require.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {
namespace {

using std::numbers::pi;

/// Numbers of nearly square cells along two directions of the given lengths, about `triangle_count` / 2 in all.
std::pair<int, int> about_square_cells(double length_u, double length_v, std::int64_t triangle_count, int least_u,
                                       int least_v) {
  const double cells = std::max(1.0, static_cast<double>(triangle_count) / 2);
  const double u = std::clamp(std::round(std::sqrt(cells * length_u / length_v)), 1.0, cells);
  const int cells_u = std::max(least_u, static_cast<int>(u));
  const int cells_v = std::max(least_v, static_cast<int>(std::lround(cells / cells_u)));
  return {cells_u, cells_v};
}

/// Adds the quads between two rows of `count` vertices, which begin at `row_a` and `row_b`, closed to a ring.
void add_ring(std::int32_t row_a, std::int32_t row_b, std::int32_t count, std::vector<Triangle>& triangles) {
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t next = (i + 1) % count;
    triangles.push_back({row_a + i, row_a + next, row_b + next});
    triangles.push_back({row_a + i, row_b + next, row_b + i});
  }
}

/// The i-th of n + 1 evenly spaced values from -length/2 to length/2. Two faces of a box get the same bits along their
/// common edge, so that they can be welded.
double lattice(double length, int i, int n) {
  return length * (static_cast<double>(2 * i - n) / (2.0 * n));
}

/// The face of a box with axes (u, v) and outward normal along w at `sign` times half the size.
TriangleMesh box_face(const Eigen::Vector3d& size, const std::array<int, 3>& cells, int u, int v, int w, int sign) {
  const auto cells_u = cells[static_cast<std::size_t>(u)];
  const auto cells_v = cells[static_cast<std::size_t>(v)];
  TriangleMesh face;
  for (int j = 0; j <= cells_v; ++j) {
    for (int i = 0; i <= cells_u; ++i) {
      Eigen::Vector3d point;
      point[u] = lattice(size[u], i, cells_u);
      point[v] = lattice(size[v], j, cells_v);
      point[w] = sign * size[w] / 2;
      face.vertices.push_back(point);
    }
  }
  for (int j = 0; j < cells_v; ++j) {
    for (int i = 0; i < cells_u; ++i) {
      const std::int32_t p00 = j * (cells_u + 1) + i;
      const std::int32_t p01 = p00 + cells_u + 1;
      face.triangles.push_back({p00, p00 + 1, p01 + 1});
      face.triangles.push_back({p00, p01 + 1, p01});
    }
  }
  if (sign < 0) {
    for (Triangle& triangle : face.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return face;
}

/// Point of the uniform Catmull-Rom spline through `points` at parameter s, 0 ≤ s ≤ points.size() - 1.
Eigen::Vector3d spline_point(std::span<const Eigen::Vector3d> points, double s) {
  const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
  const auto i = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(s)), 0, last - 1);
  const double t = s - static_cast<double>(i);
  const auto at = [&](std::ptrdiff_t k) -> Eigen::Vector3d {
    // Beyond the ends, the first and the last step are repeated.
    if (k < 0) return 2 * points[0] - points[1];
    if (k > last) {
      return 2 * points[static_cast<std::size_t>(last)] - points[static_cast<std::size_t>(last - 1)];
    }
    return points[static_cast<std::size_t>(k)];
  };
  const Eigen::Vector3d a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
  return 0.5 * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) + t * t * t * (3 * b - a - 3 * c + d));
}

/// The spline as a polygon fine enough to measure lengths on.
std::vector<Eigen::Vector3d> fine_polygon(std::span<const Eigen::Vector3d> points) {
  constexpr int kStepsPerSpan = 64;
  const int steps = kStepsPerSpan * (static_cast<int>(points.size()) - 1);
  std::vector<Eigen::Vector3d> polygon;
  for (int i = 0; i <= steps; ++i) {
    polygon.push_back(spline_point(points, static_cast<double>(i) / kStepsPerSpan));
  }
  return polygon;
}

double length_of(const std::vector<Eigen::Vector3d>& polygon) {
  double length = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    length += (polygon[i] - polygon[i - 1]).norm();
  }
  return length;
}

/// `count` + 1 points at equal distances along `polygon`, ends included.
std::vector<Eigen::Vector3d> even_points(const std::vector<Eigen::Vector3d>& polygon, int count) {
  const double step = length_of(polygon) / count;
  std::vector<Eigen::Vector3d> points{polygon.front()};
  double walked = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const double edge = (polygon[i] - polygon[i - 1]).norm();
    while (static_cast<int>(points.size()) < count && step * static_cast<double>(points.size()) <= walked + edge) {
      const double t = (step * static_cast<double>(points.size()) - walked) / edge;
      points.push_back(polygon[i - 1] + t * (polygon[i] - polygon[i - 1]));
    }
    walked += edge;
  }
  points.push_back(polygon.back());
  return points;
}

/// Parallel transport: `across`, perpendicular to `from`, turned by the smallest rotation that takes the direction
/// `from` to `to`. This keeps a hose free of twist. In closed form, because Eigen's FromTwoVectors brings in an SVD
/// that takes long to compile.
Eigen::Vector3d carried_along(const Eigen::Vector3d& across, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const double one_plus_cos = 1 + from.dot(to);
  if (one_plus_cos < 1e-12) return across;  // turned back: half a turn about `across` itself
  return across - across.dot(to) / one_plus_cos * (from + to);
}

}  // namespace

TriangleMesh make_revolution(std::span<const Eigen::Vector2d> profile, bool closed, int segments) {
  if (profile.size() < 2 || segments < 3) {
    throw std::invalid_argument(
        "A surface of revolution needs a profile of at least 2 points and at least 3 segments.");
  }
  TriangleMesh mesh;
  std::vector<std::int32_t> row_start;
  std::vector<bool> is_pole;
  for (const Eigen::Vector2d& point : profile) {
    row_start.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    is_pole.push_back(point.x() == 0);
    const int count = is_pole.back() ? 1 : segments;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * pi * i / segments;
      mesh.vertices.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
    }
  }
  const std::size_t rows = profile.size();
  for (std::size_t row = 0; row + 1 < rows + (closed ? 1 : 0); ++row) {
    const std::size_t next = (row + 1) % rows;
    if (is_pole[row] && is_pole[next]) continue;
    if (!is_pole[row] && !is_pole[next]) {
      add_ring(row_start[row], row_start[next], segments, mesh.triangles);
      continue;
    }
    for (std::int32_t i = 0; i < segments; ++i) {
      const std::int32_t j = (i + 1) % segments;
      if (is_pole[row]) {
        mesh.triangles.push_back({row_start[row], row_start[next] + j, row_start[next] + i});
      } else {
        mesh.triangles.push_back({row_start[row] + i, row_start[row] + j, row_start[next]});
      }
    }
  }
  return mesh;
}

TriangleMesh make_sphere(double radius, std::int64_t triangle_count) {
  base::require_positive("radius", radius);
  base::require_triangle_count(triangle_count);
  // Twice as many meridians as bands: 4 bands (bands - 1) triangles.
  const int bands =
      std::max(2, static_cast<int>(std::lround((1 + std::sqrt(1 + static_cast<double>(triangle_count))) / 2)));
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= bands; ++i) {
    const double latitude = pi * (static_cast<double>(i) / bands - 0.5);
    const bool is_pole = i == 0 || i == bands;
    profile.emplace_back(is_pole ? 0.0 : radius * std::cos(latitude), radius * std::sin(latitude));
  }
  return make_revolution(profile, false, 2 * bands);
}

TriangleMesh make_torus(double major_radius, double minor_radius, std::int64_t triangle_count) {
  base::require_positive("major_radius", major_radius);
  base::require_positive("minor_radius", minor_radius);
  base::require_triangle_count(triangle_count);
  if (major_radius <= minor_radius) {
    throw std::invalid_argument("major_radius must be larger than minor_radius, but is " +
                                std::to_string(major_radius) + " against " + std::to_string(minor_radius) + ".");
  }
  const auto [segments, steps] = about_square_cells(major_radius, minor_radius, triangle_count, 3, 3);
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2 * pi * i / steps;
    profile.emplace_back(major_radius + minor_radius * std::cos(angle), minor_radius * std::sin(angle));
  }
  return make_revolution(profile, true, segments);
}

TriangleMesh make_hyperboloid(double waist_radius, double rim_radius, double height, std::int64_t triangle_count) {
  base::require_positive("waist_radius", waist_radius);
  base::require_positive("rim_radius", rim_radius);
  base::require_positive("height", height);
  base::require_triangle_count(triangle_count);
  if (rim_radius <= waist_radius) {
    throw std::invalid_argument("rim_radius must be larger than waist_radius, but is " + std::to_string(rim_radius) +
                                " against " + std::to_string(waist_radius) + ".");
  }
  const double slant = std::hypot(height, 2 * (rim_radius - waist_radius));
  const auto [segments, steps] = about_square_cells(pi * (waist_radius + rim_radius), slant, triangle_count, 3, 2);
  const double growth = (rim_radius * rim_radius - waist_radius * waist_radius) / (height * height / 4);
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= steps; ++i) {
    const double z = lattice(height, i, steps);
    profile.emplace_back(std::sqrt(waist_radius * waist_radius + growth * z * z), z);
  }
  return make_revolution(profile, false, segments);
}

TriangleMesh make_box(const Eigen::Vector3d& size, std::int64_t triangle_count) {
  for (const double edge : size) {
    base::require_positive("size", edge);
  }
  base::require_triangle_count(triangle_count);
  const double area = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  const double cell = std::sqrt(2 * area / static_cast<double>(std::max<std::int64_t>(12, triangle_count)));
  std::array<int, 3> cells{};
  for (int axis = 0; axis < 3; ++axis) {
    // A limit for each axis keeps small requests from being exceeded: 12 gives the plain box.
    const double most = std::max(1.0, std::floor(static_cast<double>(triangle_count) / 12));
    cells[static_cast<std::size_t>(axis)] = static_cast<int>(std::clamp(std::round(size[axis] / cell), 1.0, most));
  }
  std::vector<TriangleMesh> faces;
  for (int w = 0; w < 3; ++w) {
    for (const int sign : {-1, 1}) {
      faces.push_back(box_face(size, cells, (w + 1) % 3, (w + 2) % 3, w, sign));
    }
  }
  return weld(merge(faces));
}

TriangleMesh make_plate(const Eigen::Vector2d& size, std::int64_t triangle_count) {
  base::require_positive("size", size.x());
  base::require_positive("size", size.y());
  base::require_triangle_count(triangle_count);
  const auto [cells_x, cells_y] = about_square_cells(size.x(), size.y(), triangle_count, 1, 1);
  return box_face({size.x(), size.y(), 0}, {cells_x, cells_y, 1}, 0, 1, 2, 1);
}

TriangleMesh make_tube(double radius, double length, std::int64_t triangle_count) {
  base::require_positive("radius", radius);
  base::require_positive("length", length);
  base::require_triangle_count(triangle_count);
  const auto [segments, steps] = about_square_cells(2 * pi * radius, length, triangle_count, 3, 1);
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= steps; ++i) {
    profile.emplace_back(radius, lattice(length, i, steps));
  }
  return make_revolution(profile, false, segments);
}

TriangleMesh make_hose(std::span<const Eigen::Vector3d> points, double radius, std::int64_t triangle_count) {
  base::require_positive("radius", radius);
  base::require_triangle_count(triangle_count);
  if (points.size() < 2) throw std::invalid_argument("A hose needs at least 2 points to go through.");
  for (std::size_t i = 1; i < points.size(); ++i) {
    base::require_positive("the distance between successive points of a hose", (points[i] - points[i - 1]).norm());
  }
  const std::vector<Eigen::Vector3d> polygon = fine_polygon(points);
  const auto [segments, steps] = about_square_cells(2 * pi * radius, length_of(polygon), triangle_count, 3, 1);
  const std::vector<Eigen::Vector3d> centers = even_points(polygon, steps);

  TriangleMesh mesh;
  Eigen::Vector3d tangent = (centers[1] - centers[0]).normalized();
  Eigen::Vector3d across = tangent.unitOrthogonal();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const Eigen::Vector3d next_tangent =
        (centers[std::min(i + 1, centers.size() - 1)] - centers[i == 0 ? 0 : i - 1]).normalized();
    across = carried_along(across, tangent, next_tangent);
    across = (across - across.dot(next_tangent) * next_tangent).normalized();
    tangent = next_tangent;
    const Eigen::Vector3d other = tangent.cross(across);
    for (int k = 0; k < segments; ++k) {
      const double angle = 2 * pi * k / segments;
      mesh.vertices.push_back(centers[i] + radius * (std::cos(angle) * across + std::sin(angle) * other));
    }
    if (i > 0) {
      const auto row = static_cast<std::int32_t>(i) * segments;
      add_ring(row - segments, row, segments, mesh.triangles);
    }
  }
  return mesh;
}

}  // namespace glissade::geometry

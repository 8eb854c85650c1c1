#include "household/solids.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <glissade/geometry/mesh_generators.h>

namespace glissade::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::TriangleMesh;
using std::numbers::pi;

constexpr double kMostTurn = 0.35;  // rad, from one edge of a polygon to the next
constexpr int kLeastAround = 20;

/// The points of a curve at which a polygon keeps within `edge` and within the turn. All ends of spans are among them.
std::vector<Vector2d> polygon_of(const PlaneCurve& curve, double edge) {
  constexpr int kFine = 32;
  std::vector<Vector2d> points{curve.point(0.0)};
  for (std::size_t span = 0; span < curve.axis.spans.size(); ++span) {
    const auto at = [&](int i) -> Vector2d {
      return curve.point(static_cast<double>(span) + static_cast<double>(i) / kFine);
    };
    Vector2d direction = at(1) - at(0);
    for (int i = 1; i <= kFine; ++i) {
      const Vector2d ahead = i < kFine ? Vector2d(at(i + 1) - at(i)) : direction;
      const double turn = std::atan2(direction.x() * ahead.y() - direction.y() * ahead.x(), direction.dot(ahead));
      if (i < kFine && std::abs(turn) < kMostTurn && (at(i + 1) - points.back()).norm() <= edge) continue;
      points.push_back(at(i));
      direction = ahead;
    }
  }
  if (curve.axis.is_closed) points.pop_back();
  return points;
}

int cells(double length, double edge, int least) {
  return std::max(least, static_cast<int>(std::ceil(length / edge)));
}

/// The outward normals of a closed polygon's corners that run counterclockwise.
std::vector<Vector2d> normals_of(const std::vector<Vector2d>& polygon) {
  std::vector<Vector2d> normals;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d along = polygon[(i + 1) % n] - polygon[(i + n - 1) % n];
    normals.push_back(Vector2d(along.y(), -along.x()).normalized());
  }
  return normals;
}

double power_of(double x, double exponent) {
  return std::copysign(std::pow(std::abs(x), exponent), x);
}

}  // namespace

std::vector<Corner> in_mm(std::vector<Corner> corners) {
  for (Corner& corner : corners)
    corner = {1e-3 * corner.x, 1e-3 * corner.y, 1e-3 * corner.radius};
  return corners;
}

TriangleMesh loft(const std::vector<SpaceLoop>& loops, bool is_ring) {
  TriangleMesh mesh;
  const std::size_t n = loops.front().size();
  for (const SpaceLoop& loop : loops)
    mesh.vertices.insert(mesh.vertices.end(), loop.begin(), loop.end());
  const auto vertex = [&](std::size_t loop, std::size_t i) {
    return static_cast<std::int32_t>(loop % loops.size() * n + i % n);
  };
  for (std::size_t loop = 0; loop + (is_ring ? 0 : 1) < loops.size(); ++loop) {
    for (std::size_t i = 0; i < n; ++i) {
      mesh.triangles.push_back({vertex(loop, i), vertex(loop, i + 1), vertex(loop + 1, i + 1)});
      mesh.triangles.push_back({vertex(loop, i), vertex(loop + 1, i + 1), vertex(loop + 1, i)});
    }
  }
  if (is_ring) return mesh;
  for (const std::size_t loop : {std::size_t{0}, loops.size() - 1}) {
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& p : loops[loop])
      middle += p / static_cast<double>(n);
    const auto center = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back(middle);
    for (std::size_t i = 0; i < n; ++i)
      mesh.triangles.push_back({vertex(loop, loop == 0 ? i + 1 : i), vertex(loop, loop == 0 ? i : i + 1), center});
  }
  return mesh;
}

TriangleMesh turned_solid(const std::vector<Corner>& profile, double edge) {
  const std::vector<Vector2d> points = polygon_of(rounded_path(profile, false), edge);
  double radius = 0.0;
  for (const Vector2d& point : points)
    radius = std::max(radius, point.x());
  return geometry::make_revolution(points, false, cells(2 * pi * radius, edge, kLeastAround));
}

TriangleMesh plate_solid(const PlaneCurve& outline, double thickness, double rounding, double edge) {
  const std::vector<Vector2d> polygon = polygon_of(outline, edge);
  const std::vector<Vector2d> normals = normals_of(polygon);
  const auto loop_at = [&](double inset, double z) {
    SpaceLoop loop;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2d p = polygon[i] - inset * normals[i];
      loop.emplace_back(p.x(), p.y(), z);
    }
    return loop;
  };
  constexpr int kSteps = 3;
  const double straight = thickness / 2 - rounding;
  std::vector<SpaceLoop> loops;
  for (const double side : {-1.0, 1.0}) {
    for (int step = 0; step <= kSteps; ++step) {
      const double angle = pi / 2 * (side < 0 ? kSteps - step : step) / kSteps;
      loops.push_back(loop_at(rounding * (1 - std::cos(angle)), side * (straight + rounding * std::sin(angle))));
    }
    const int rows = cells(2 * straight, edge, 1);
    for (int row = 1; side < 0 && row < rows; ++row)
      loops.push_back(loop_at(0.0, straight * (2.0 * row / rows - 1)));
  }
  return loft(loops, false);
}

std::vector<SpaceLoop> swept_loops(const Sweep& sweep, double edge) {
  double length = 0.0;
  double widest = 0.0;
  constexpr int kSamples = 64;
  for (int i = 0; i < kSamples; ++i) {
    const double t = static_cast<double>(i) / kSamples;
    length += (sweep.path(t + 1.0 / kSamples) - sweep.path(t)).norm();
    widest = std::max(widest, sweep.half_size(t).maxCoeff());
  }
  const int around = cells(2 * pi * widest, edge, kLeastAround);
  const int along = cells(length, edge, 12);
  const auto loop_at = [&](double t, double scale, double ahead) {
    constexpr double kNear = 1e-4;
    const double low = sweep.is_ring ? t - kNear : std::max(0.0, t - kNear);
    const double high = sweep.is_ring ? t + kNear : std::min(1.0, t + kNear);
    const Vector3d tangent = (sweep.path(high) - sweep.path(low)).normalized();
    const Vector3d side = sweep.up.cross(tangent).normalized();
    const Vector2d half = scale * sweep.half_size(t);
    SpaceLoop loop;
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      loop.push_back(sweep.path(t) + ahead * tangent + half.x() * power_of(std::cos(angle), 2 / sweep.power) * side +
                     half.y() * power_of(std::sin(angle), 2 / sweep.power) * sweep.up);
    }
    return loop;
  };
  std::vector<SpaceLoop> loops;
  const auto add_dome = [&](double t, double direction) {
    constexpr int kSteps = 3;
    if (sweep.dome == 0.0) return;
    const double height = sweep.dome * sweep.half_size(t).y();
    for (int step = 1; step <= kSteps; ++step) {
      const double angle = 0.45 * pi * (direction < 0 ? kSteps + 1 - step : step) / kSteps;
      loops.push_back(loop_at(t, std::cos(angle), direction * height * std::sin(angle)));
    }
  };
  add_dome(0.0, -1.0);
  for (int i = 0; i < along + (sweep.is_ring ? 0 : 1); ++i)
    loops.push_back(loop_at(static_cast<double>(i) / along, 1.0, 0.0));
  add_dome(1.0, 1.0);
  return loops;
}

TriangleMesh swept_solid(const Sweep& sweep, double edge) {
  return loft(swept_loops(sweep, edge), sweep.is_ring);
}

std::function<Vector3d(double t)> bezier_mm(const std::vector<Vector3d>& points) {
  return [points](double t) -> Vector3d {
    const double s = 1 - t;
    return 1e-3 *
           (s * s * s * points[0] + 3 * s * s * t * points[1] + 3 * s * t * t * points[2] + t * t * t * points[3]);
  };
}

void add(TriangleMesh& mesh, const TriangleMesh& part, const Eigen::Isometry3d& X) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Vector3d& p : part.vertices)
    mesh.vertices.push_back(X * p);
  for (const geometry::Triangle& t : part.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace glissade::shapes

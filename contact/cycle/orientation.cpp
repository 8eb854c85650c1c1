#include "cycle/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

#include <Eigen/Geometry>

namespace glissade::contact {
namespace {

/// A side of a triangle, between two vertices in ascending order.
struct Side {
  std::array<std::int32_t, 2> ends;
  std::int32_t triangle;
  bool is_forward;  ///< the triangle goes from the first end to the second
};

std::vector<Side> sides_by_edge(const geometry::TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::int32_t t = 0; t < std::ssize(mesh.triangles); ++t) {
    const geometry::Triangle& triangle = mesh.triangles[static_cast<std::size_t>(t)];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangle[i];
      const std::int32_t b = triangle[(i + 1) % 3];
      if (a != b) sides.push_back({{std::min(a, b), std::max(a, b)}, t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& other) {
    return s.ends != other.ends ? s.ends < other.ends : s.triangle < other.triangle;
  });
  return sides;
}

template <typename Visit>
void visit_edges(std::span<const Side> sides, const Visit& visit) {
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t end = first + 1;
    while (end < sides.size() && sides[end].ends == sides[first].ends)
      ++end;
    visit(sides.subspan(first, end - first));
    first = end;
  }
}

/// Six times the volume between a triangle and a point.
double volume(const geometry::TriangleMesh& mesh, std::size_t triangle, const Eigen::Vector3d& p) {
  const std::array<Eigen::Vector3d, 3> x = mesh.corners(static_cast<std::int32_t>(triangle));
  return (x[0] - p).dot((x[1] - p).cross(x[2] - p));
}

/// The solid angle of a triangle seen from p (van Oosterom and Strackee).
double solid_angle(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& p) {
  const Eigen::Vector3d a = triangle[0] - p;
  const Eigen::Vector3d b = triangle[1] - p;
  const Eigen::Vector3d c = triangle[2] - p;
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

/// A triangle across an edge, and whether it has the other orientation.
struct Neighbor {
  std::size_t triangle;
  bool is_flipped;
};

/// Gives the triangles of each connected surface one orientation, and its outside a positive sign. Returns nothing for
/// a surface of one side.
std::vector<std::int8_t> oriented(const geometry::TriangleMesh& mesh,
                                  const std::vector<std::vector<Neighbor>>& neighbors) {
  std::vector<std::int8_t> signs(mesh.triangles.size(), 0);
  std::vector<std::size_t> surface;
  for (std::size_t first = 0; first < signs.size(); ++first) {
    if (signs[first] != 0) continue;
    surface.assign(1, first);
    signs[first] = 1;
    double enclosed = 0.0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const std::size_t t = surface[i];
      enclosed += signs[t] * volume(mesh, t, mesh.corner(static_cast<std::int32_t>(first), 0));
      for (const Neighbor& neighbor : neighbors[t]) {
        const auto sign = static_cast<std::int8_t>(neighbor.is_flipped ? -signs[t] : signs[t]);
        if (signs[neighbor.triangle] == 0) {
          signs[neighbor.triangle] = sign;
          surface.push_back(neighbor.triangle);
        } else if (signs[neighbor.triangle] != sign) {
          return {};
        }
      }
    }
    if (enclosed >= 0.0) continue;
    for (const std::size_t t : surface)
      signs[t] = static_cast<std::int8_t>(-signs[t]);
  }
  return signs;
}

/// A connected part of a surface whose triangles have one orientation.
struct Shell {
  std::vector<std::size_t> triangles;
  Eigen::AlignedBox3d bounds;
  double enclosed = 0.0;  ///< six times the volume; negative where the normals point inwards
};

std::vector<Shell> shells_of(const geometry::TriangleMesh& mesh, std::span<const Side> sides) {
  std::vector<std::vector<std::size_t>> neighbors(mesh.triangles.size());
  visit_edges(sides, [&](std::span<const Side> edge) {
    const auto first = static_cast<std::size_t>(edge[0].triangle);
    for (const Side& side : edge.subspan(1)) {
      neighbors[first].push_back(static_cast<std::size_t>(side.triangle));
      neighbors[static_cast<std::size_t>(side.triangle)].push_back(first);
    }
  });
  std::vector<char> is_known(mesh.triangles.size(), 0);
  std::vector<Shell> shells;
  for (std::size_t first = 0; first < mesh.triangles.size(); ++first) {
    if (is_known[first]) continue;
    is_known[first] = 1;
    Shell& shell = shells.emplace_back();
    shell.triangles.push_back(first);
    for (std::size_t i = 0; i < shell.triangles.size(); ++i) {
      const std::size_t t = shell.triangles[i];
      for (const Eigen::Vector3d& corner : mesh.corners(static_cast<std::int32_t>(t)))
        shell.bounds.extend(corner);
      shell.enclosed += volume(mesh, t, mesh.corner(static_cast<std::int32_t>(first), 0));
      for (const std::size_t neighbor : neighbors[t]) {
        if (!std::exchange(is_known[neighbor], 1)) shell.triangles.push_back(neighbor);
      }
    }
  }
  return shells;
}

/// Whether p is inside of a shell, whatever its orientation.
bool is_inside(const geometry::TriangleMesh& mesh, const Shell& shell, const Eigen::Vector3d& p) {
  if (!shell.bounds.contains(p)) return false;
  double sum = 0.0;
  for (const std::size_t t : shell.triangles)
    sum += solid_angle(mesh.corners(static_cast<std::int32_t>(t)), p);
  return std::abs(sum) > 2.0 * std::numbers::pi;  // rounding is far from a half of the full angle
}

/// Shells inside of no other enclose what is inside of them. Those inside of such a one keep their orientation relative
/// to it: they are cavities, or solids.
std::vector<std::int8_t> signs_of(const geometry::TriangleMesh& mesh, const std::vector<Shell>& shells) {
  std::vector<std::int8_t> signs(mesh.triangles.size(), 1);
  for (const Shell& shell : shells) {
    const Shell* outermost = &shell;
    for (const Shell& other : shells) {
      const bool is_larger = std::abs(other.enclosed) > std::abs(outermost->enclosed);
      const Eigen::Vector3d& p = mesh.corner(static_cast<std::int32_t>(shell.triangles.front()), 0);
      if (is_larger && is_inside(mesh, other, p)) outermost = &other;
    }
    if (outermost->enclosed >= 0.0) continue;
    for (const std::size_t t : shell.triangles)
      signs[t] = -1;
  }
  return signs;
}

}  // namespace

std::vector<std::int8_t> outward_signs(const geometry::TriangleMesh& mesh) {
  const std::vector<Side> sides = sides_by_edge(mesh);
  bool has_one_orientation = true;
  bool is_closed = true;
  visit_edges(sides, [&](std::span<const Side> edge) {
    const auto forward = std::count_if(edge.begin(), edge.end(), [](const Side& side) { return side.is_forward; });
    has_one_orientation = has_one_orientation && 2 * forward == std::ssize(edge);
    is_closed = is_closed && edge.size() == 2;
  });
  if (has_one_orientation) return signs_of(mesh, shells_of(mesh, sides));
  if (!is_closed) return {};
  std::vector<std::vector<Neighbor>> neighbors(mesh.triangles.size());
  visit_edges(sides, [&](std::span<const Side> edge) {
    const auto a = static_cast<std::size_t>(edge[0].triangle);
    const auto b = static_cast<std::size_t>(edge[1].triangle);
    const bool is_flipped = edge[0].is_forward == edge[1].is_forward;
    neighbors[a].push_back({b, is_flipped});
    neighbors[b].push_back({a, is_flipped});
  });
  return oriented(mesh, neighbors);
}

bool encloses(const geometry::TriangleMesh& mesh, const Eigen::Vector3d& p) {
  if (!geometry::bounds_of(mesh).contains(p)) return false;
  const std::vector<std::int8_t> signs = outward_signs(mesh);
  double sum = 0.0;
  for (std::size_t t = 0; t < signs.size(); ++t)
    sum += signs[t] * solid_angle(mesh.corners(static_cast<std::int32_t>(t)), p);
  return sum > 2.0 * std::numbers::pi;  // rounding is far from a half of the full angle
}

}  // namespace glissade::contact

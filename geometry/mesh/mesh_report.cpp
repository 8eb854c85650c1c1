#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/geometry/triangle_pair.h>

namespace glissade::geometry {
namespace {

/// A side of a triangle: its vertices in ascending order, and whether the triangle traverses it in that order.
struct Side {
  std::int32_t low;
  std::int32_t high;
  bool is_ascending;

  bool operator<(const Side& other) const { return std::tie(low, high) < std::tie(other.low, other.high); }
};

void check_indices(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::int32_t corner : mesh.triangles[t]) {
      if (corner >= 0 && static_cast<std::size_t>(corner) < mesh.vertices.size()) continue;
      throw std::invalid_argument("Triangle " + std::to_string(t) + " uses vertex " + std::to_string(corner) +
                                  ", but the mesh has " + std::to_string(mesh.vertices.size()) + " vertices.");
    }
  }
}

void count_edges(const std::vector<Triangle>& triangles, MeshReport& result) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangle[i];
      const std::int32_t b = triangle[(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::upper_bound(first, sides.end(), *first);
    const auto uses = last - first;
    if (uses == 1) ++result.open_edges;
    if (uses == 2 && first->is_ascending == (first + 1)->is_ascending) ++result.inconsistent_edges;
    if (uses > 2) ++result.nonmanifold_edges;
    first = last;
  }
}

std::int64_t count_duplicates(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) {
    std::sort(triangle.begin(), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles.end() - std::unique(triangles.begin(), triangles.end());
}

std::int64_t count_components(const std::vector<Triangle>& triangles, std::size_t vertices) {
  std::vector<std::int32_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (parent[static_cast<std::size_t>(v)] != v) {
      auto& up = parent[static_cast<std::size_t>(v)];
      up = parent[static_cast<std::size_t>(up)];
      v = up;
    }
    return v;
  };
  std::vector<bool> is_used(vertices, false);
  for (const Triangle& triangle : triangles) {
    for (const std::int32_t corner : triangle) {
      is_used[static_cast<std::size_t>(corner)] = true;
      parent[static_cast<std::size_t>(root(corner))] = root(triangle[0]);
    }
  }
  std::int64_t components = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (is_used[v] && parent[v] == static_cast<std::int32_t>(v)) ++components;
  }
  return components;
}

}  // namespace

MeshReport report(const TriangleMesh& mesh) {
  check_indices(mesh);
  MeshReport result;
  result.vertices = static_cast<std::int64_t>(mesh.vertices.size());
  result.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  std::vector<Triangle> sound;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const auto corner = [&](int i) { return mesh.corner(static_cast<std::int32_t>(t), i); };
    if (is_degenerate({corner(0), corner(1), corner(2)})) {
      ++result.degenerate;
      continue;
    }
    sound.push_back(triangle);
    result.area += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
    for (int i = 0; i < 3; ++i) {
      result.bounds.extend(corner(i));
    }
  }
  count_edges(sound, result);
  result.duplicates = count_duplicates(sound);
  result.components = count_components(sound, mesh.vertices.size());
  result.is_watertight = !sound.empty() && result.open_edges == 0 && result.nonmanifold_edges == 0;
  return result;
}

}  // namespace glissade::geometry

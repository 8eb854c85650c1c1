#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {
namespace {

struct PositionHash {
  std::size_t operator()(const std::array<double, 3>& position) const {
    std::size_t hash = 0;
    for (const double coordinate : position) {
      hash = hash * 0x9E3779B97F4A7C15ULL + std::hash<double>{}(coordinate);
    }
    return hash ^ (hash >> 29);
  }
};

}  // namespace

TriangleMesh merge(std::span<const TriangleMesh> meshes) {
  TriangleMesh merged;
  for (const TriangleMesh& mesh : meshes) {
    const std::size_t offset = merged.vertices.size();
    if (offset + mesh.vertices.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw std::invalid_argument("The merged mesh would have more than 2147483647 vertices.");
    }
    merged.vertices.insert(merged.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    const auto shift = static_cast<std::int32_t>(offset);
    for (const Triangle& triangle : mesh.triangles) {
      merged.triangles.push_back({triangle[0] + shift, triangle[1] + shift, triangle[2] + shift});
    }
  }
  return merged;
}

TriangleMesh transformed(const TriangleMesh& mesh_B, const Eigen::Isometry3d& X_AB) {
  TriangleMesh mesh_A = mesh_B;
  for (Eigen::Vector3d& vertex : mesh_A.vertices) {
    vertex = X_AB * vertex;
  }
  return mesh_A;
}

TriangleMesh flip_randomly(const TriangleMesh& mesh, std::uint64_t seed) {
  TriangleMesh flipped = mesh;
  std::mt19937_64 generator(seed);
  for (Triangle& triangle : flipped.triangles) {
    // The lowest bit rather than a distribution: distributions differ between standard libraries.
    if ((generator() & 1U) != 0U) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return flipped;
}

TriangleMesh weld(const TriangleMesh& mesh) {
  TriangleMesh welded;
  welded.triangles.reserve(mesh.triangles.size());
  std::unordered_map<std::array<double, 3>, std::int32_t, PositionHash> vertex_at;
  vertex_at.reserve(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      // Adding zero turns -0 into 0, so that the two share a key.
      const Eigen::Vector3d position =
          mesh.corner(static_cast<std::int32_t>(t), static_cast<int>(corner)) + Eigen::Vector3d::Zero();
      const auto [entry, is_new] = vertex_at.try_emplace({position.x(), position.y(), position.z()},
                                                         static_cast<std::int32_t>(welded.vertices.size()));
      if (is_new) welded.vertices.push_back(position);
      triangle[corner] = entry->second;
    }
    welded.triangles.push_back(triangle);
  }
  return welded;
}

Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    bounds.extend(vertex);
  return bounds;
}

std::vector<std::int32_t> triangles_inside(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box) {
  std::vector<std::int32_t> inside;
  for (std::int32_t t = 0; t < std::ssize(mesh.triangles); ++t) {
    if (box.contains(mesh.corner(t, 0)) && box.contains(mesh.corner(t, 1)) && box.contains(mesh.corner(t, 2)))
      inside.push_back(t);
  }
  return inside;
}

TriangleMesh without_triangles(const TriangleMesh& mesh, std::span<const std::int32_t> triangles) {
  TriangleMesh rest = mesh;
  for (const std::int32_t t : triangles) {
    Triangle& triangle = rest.triangles[static_cast<std::size_t>(t)];
    triangle = {triangle[0], triangle[0], triangle[0]};
  }
  return rest;
}

}  // namespace glissade::geometry

#include "model/display_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <meshoptimizer.h>

#include <glissade/geometry/mesh_topology.h>

namespace glissade::viewer {

namespace {

constexpr double kGrid = 65535.0;
constexpr double kCosCrease = 0.8660254037844387;  // of 30°

/// The triangles at each vertex, stored end to end.
class Fans {
 public:
  Fans(std::span<const std::uint32_t> indices, std::size_t vertices)
      : start_(vertices + 1, 0), triangles_(indices.size()) {
    for (const std::uint32_t vertex : indices)
      ++start_[vertex + 1];
    for (std::size_t v = 0; v < vertices; ++v)
      start_[v + 1] += start_[v];
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < indices.size(); ++i)
      triangles_[next[indices[i]]++] = static_cast<std::uint32_t>(i / 3);
  }

  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return {triangles_.data() + start_[vertex], triangles_.data() + start_[vertex + 1]};
  }

 private:
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> triangles_;
};

/// The indices of fewer triangles. Keeps the shape first; a mesh of many loose pieces does not get small that way, so
/// then pieces melt into each other.
std::vector<std::uint32_t> simplified(const std::vector<std::uint32_t>& indices, const std::vector<float>& vertices,
                                      std::size_t most_triangles) {
  constexpr std::size_t kStride = 3 * sizeof(float);
  constexpr std::size_t kLargestForShape = 1'500'000;  // indices: beyond, keeping the shape takes seconds
  const std::size_t wanted = 3 * most_triangles;
  const std::size_t vertex_count = vertices.size() / 3;
  std::vector<std::uint32_t> result(indices.size());
  if (indices.size() <= kLargestForShape) {
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), vertices.data(), vertex_count,
                                   kStride, wanted, 0.02F, 0, nullptr));
    if (result.size() <= wanted + wanted / 4) return result;
    result.resize(indices.size());
  }
  result.resize(meshopt_simplifySloppy(result.data(), indices.data(), indices.size(), vertices.data(), vertex_count,
                                       kStride, wanted, 1.0F, nullptr));
  return result;
}

std::vector<std::uint32_t> indices_of(const geometry::TriangleMesh& mesh) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const geometry::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t vertex : triangle)
      indices.push_back(static_cast<std::uint32_t>(vertex));
  }
  return indices;
}

Eigen::AlignedBox3d bounds_of_triangles(const geometry::TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const geometry::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t vertex : triangle)
      bounds.extend(mesh.vertices[static_cast<std::size_t>(vertex)]);
  }
  return bounds;
}

std::array<std::int8_t, 4> rounded(const Eigen::Vector3d& normal) {
  const auto part = [&](int axis) { return static_cast<std::int8_t>(std::lround(127.0 * normal[axis])); };
  return {part(0), part(1), part(2), 0};
}

/// Splits the vertices of `mesh`, which has no normals yet, along its creases.
class NormalMaker {
 public:
  NormalMaker(const geometry::TriangleMesh& source, DisplayMesh& mesh)
      : mesh_(mesh), fans_(mesh.indices, source.vertices.size()), variants_(source.vertices.size(), kNone) {
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
      const auto corner = [&](std::size_t i) { return source.vertices[mesh.indices[3 * t + i]]; };
      areas_.push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)));
    }
  }

  void run(const std::vector<std::array<std::uint16_t, 4>>& positions) {
    std::vector<std::uint32_t> split(mesh_.indices.size());
    for (std::size_t i = 0; i < split.size(); ++i)
      split[i] = vertex_for(mesh_.indices[i], rounded(normal_at(mesh_.indices[i], i / 3)), positions);
    mesh_.indices = std::move(split);
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// The mean of the normals at the vertex that differ little from that of the triangle, by area.
  Eigen::Vector3d normal_at(std::uint32_t vertex, std::size_t triangle) const {
    constexpr std::size_t kLargestFan = 64;  // at the middle of a disc, all normals are alike
    const Eigen::Vector3d& own = areas_[triangle];
    if (fans_.at(vertex).size() > kLargestFan) return own.normalized();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t other : fans_.at(vertex)) {
      const double product = own.dot(areas_[other]);
      if (std::abs(product) < kCosCrease * own.norm() * areas_[other].norm()) continue;
      sum += product < 0.0 ? Eigen::Vector3d(-areas_[other]) : areas_[other];
    }
    return sum.normalized();
  }

  std::uint32_t vertex_for(std::uint32_t source, const std::array<std::int8_t, 4>& normal,
                           const std::vector<std::array<std::uint16_t, 4>>& positions) {
    for (std::uint32_t v = variants_[source]; v != kNone; v = next_[v]) {
      if (mesh_.normals[v] == normal) return v;
    }
    mesh_.positions.push_back(positions[source]);
    mesh_.normals.push_back(normal);
    next_.push_back(variants_[source]);
    return variants_[source] = static_cast<std::uint32_t>(next_.size() - 1);
  }

  DisplayMesh& mesh_;
  Fans fans_;
  std::vector<Eigen::Vector3d> areas_;   // twice the area times the normal, by triangle
  std::vector<std::uint32_t> variants_;  // by source vertex: the newest of its vertices in the mesh
  std::vector<std::uint32_t> next_;      // by vertex: the one before it with the same source
};

/// Whether two triangles meet at more than 30°, or other than two triangles.
bool is_sharp(const geometry::TriangleMesh& mesh, const geometry::MeshTopology& topology, std::size_t number) {
  const geometry::MeshTopology::Edge& edge = topology.edges()[number];
  if (edge.flat) return false;
  const std::span<const std::int32_t> apexes = topology.apexes_of(static_cast<std::int32_t>(number));
  if (apexes.size() != 2) return true;
  const auto point = [&](std::int32_t vertex) { return mesh.vertices[static_cast<std::size_t>(vertex)]; };
  const Eigen::Vector3d along = point(edge.vertices[1]) - point(edge.vertices[0]);
  const auto normal = [&](std::int32_t apex) -> Eigen::Vector3d {
    return along.cross(point(apex) - point(edge.vertices[0])).normalized();
  };
  return -normal(apexes[0]).dot(normal(apexes[1])) < kCosCrease;
}

/// The numbers of the longest sharp edges, at most `most`, in their order in the mesh.
std::vector<std::size_t> sharp_edges(const geometry::TriangleMesh& mesh, const geometry::MeshTopology& topology,
                                     std::size_t most) {
  std::vector<std::size_t> sharp;
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    if (is_sharp(mesh, topology, e)) sharp.push_back(e);
  }
  if (sharp.size() <= most) return sharp;
  const auto length = [&](std::size_t e) {
    const auto& [from, to] = topology.edges()[e].vertices;
    return (mesh.vertices[static_cast<std::size_t>(from)] - mesh.vertices[static_cast<std::size_t>(to)]).squaredNorm();
  };
  const auto end = sharp.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(sharp.begin(), end, sharp.end(),
                   [&](std::size_t a, std::size_t b) { return std::pair(-length(a), a) < std::pair(-length(b), b); });
  sharp.erase(end, sharp.end());
  std::sort(sharp.begin(), sharp.end());
  return sharp;
}

std::vector<std::array<std::uint16_t, 4>> edges_of(const geometry::TriangleMesh& mesh,
                                                   const std::vector<std::array<std::uint16_t, 4>>& positions,
                                                   std::size_t most_triangles) {
  constexpr std::size_t kMostTriangles = 1'000'000;
  std::vector<std::array<std::uint16_t, 4>> ends;
  if (mesh.triangles.size() > kMostTriangles) return ends;
  // A line takes a graphics card about as long as a triangle: a small model has few of both.
  const bool is_small = mesh.triangles.size() > most_triangles;
  const geometry::MeshTopology topology(mesh);
  for (const std::size_t e : sharp_edges(mesh, topology, is_small ? 24 + most_triangles / 4 : SIZE_MAX)) {
    for (const std::int32_t vertex : topology.edges()[e].vertices)
      ends.push_back(positions[static_cast<std::size_t>(vertex)]);
  }
  return ends;
}

}  // namespace

DisplayMesh display_mesh(const geometry::TriangleMesh& mesh, std::size_t most_triangles) {
  DisplayMesh result;
  const Eigen::AlignedBox3d bounds = bounds_of_triangles(mesh);
  if (bounds.isEmpty()) return result;
  result.lower = bounds.min();
  const double size = bounds.sizes().maxCoeff();
  result.step = size > 0.0 ? size / kGrid : 1.0;
  const auto on_grid = [&](const Eigen::Vector3d& vertex) {
    return ((vertex - result.lower) / result.step).cwiseMax(0.0).cwiseMin(kGrid).array().round().eval();
  };
  std::vector<std::array<std::uint16_t, 4>> positions;
  std::vector<float> vertices;
  positions.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Array3d place = on_grid(vertex);
    const auto part = [&](int axis) { return static_cast<std::uint16_t>(place[axis]); };
    positions.push_back({part(0), part(1), part(2), 0});
    for (int axis = 0; axis < 3; ++axis)
      vertices.push_back(static_cast<float>(place[axis]));
  }
  result.edges = edges_of(mesh, positions, most_triangles);
  result.indices = indices_of(mesh);
  if (result.triangles() > most_triangles) result.indices = simplified(result.indices, vertices, most_triangles);
  NormalMaker(mesh, result).run(positions);
  return result;
}

}  // namespace glissade::viewer

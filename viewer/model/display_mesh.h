#pragma once

/// A mesh as a graphics card wants it: quantized, with normals at its vertices.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::viewer {

struct DisplayMesh {
  /// Vertex = lower + step · position, in metres. The fourth number fills the vertex up to eight bytes.
  std::vector<std::array<std::uint16_t, 4>> positions;
  std::vector<std::array<std::int8_t, 4>> normals;  ///< times 127; the fourth number is 0
  std::vector<std::uint32_t> indices;
  /// Two ends for each sharp edge and each rim of the mesh before it was simplified, on the same grid. A mesh that was
  /// has only the longest of them, about a quarter as many as triangles.
  std::vector<std::array<std::uint16_t, 4>> edges;
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
  double step = 1.0;  ///< the longest side of the bounding box / 65535

  std::size_t triangles() const { return indices.size() / 3; }
};

/// The mesh with at most about `most_triangles` triangles: a larger one is simplified. Two triangles that meet at less
/// than 30° look like one smooth surface, whatever their orientations; a vertex on a sharper edge has several normals.
/// Meshes of more than a million triangles have no edges, which take seconds.
/// Where more than 64 triangles meet, each has its own normal. About 1 s for a
/// million triangles.
DisplayMesh display_mesh(const geometry::TriangleMesh& mesh, std::size_t most_triangles);

}  // namespace glissade::viewer

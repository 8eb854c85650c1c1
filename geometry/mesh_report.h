#pragma once

/// Size and defects of a mesh, for the user's information. Meshes with these defects are valid input for this library.

#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// Counts for a welded mesh: edges and components are found by shared vertex indices, not by positions. Degenerate
/// triangles appear in `triangles` and `degenerate` only.
struct MeshReport {
  std::int64_t vertices = 0;            ///< including vertices that no triangle uses
  std::int64_t triangles = 0;           ///< including degenerate triangles
  std::int64_t degenerate = 0;          ///< triangles without area
  std::int64_t duplicates = 0;          ///< triangles with the same three vertices as an earlier triangle
  std::int64_t open_edges = 0;          ///< edges of only one triangle: the boundary
  std::int64_t nonmanifold_edges = 0;   ///< edges of more than two triangles
  std::int64_t inconsistent_edges = 0;  ///< edges that exactly two triangles share and traverse in the same direction
  std::int64_t components = 0;          ///< sets of triangles connected through shared vertices
  bool is_watertight = false;           ///< no open and no non-manifold edge, and at least one triangle
  double area = 0;                      ///< in m²
  Eigen::AlignedBox3d bounds;           ///< in metres; empty without triangles
};

/// Counts the elements and defects of a mesh. Throws std::invalid_argument for an index out of range. Cost O(n log n).
MeshReport report(const TriangleMesh& mesh);

}  // namespace glissade::geometry

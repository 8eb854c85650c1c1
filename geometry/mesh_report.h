#pragma once

/// What a mesh is made of and where it is defective. None of the defects keeps a mesh from being used here; the report
/// is for people who wonder what they were given.

#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::geometry {

/// Counts for a welded mesh: edges and components are told by shared vertex indices. Degenerate triangles are counted
/// and otherwise left out.
struct MeshReport {
  std::int64_t vertices = 0;            ///< all of them, used or not
  std::int64_t triangles = 0;           ///< all of them, degenerate ones included
  std::int64_t degenerate = 0;          ///< triangles without area
  std::int64_t duplicates = 0;          ///< triangles with the same three vertices as an earlier one, in any order
  std::int64_t open_edges = 0;          ///< edges of one triangle: the boundary
  std::int64_t nonmanifold_edges = 0;   ///< edges of more than two triangles
  std::int64_t inconsistent_edges = 0;  ///< edges whose two triangles run through them in the same direction
  std::int64_t components = 0;          ///< sets of triangles connected through shared vertices
  bool is_watertight = false;           ///< no open and no non-manifold edge, and at least one triangle
  double area = 0;                      ///< in m²
  Eigen::AlignedBox3d bounds;           ///< of the triangles' vertices, in metres; empty without triangles
};

/// Looks at every triangle. Throws std::invalid_argument for an index out of range. Cost O(n log n).
MeshReport report(const TriangleMesh& mesh);

}  // namespace glissade::geometry

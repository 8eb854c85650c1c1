#pragma once

/// A triangle soup with shared vertices: what every query of this component works on.

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace glissade::collision {

/// Indices of a triangle's three vertices.
using Triangle = std::array<std::int32_t, 3>;

/// Triangles over an indexed set of vertices, in metres, in the frame of the object they belong to.
///
/// Nothing is assumed of them: they may be open, non-manifold, self-intersecting, inconsistently oriented, and
/// degenerate. Two triangles are neighbours only where they share vertex indices, so meshes should be welded
/// (`mesh_import.h` does).
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;

  /// Corner `corner` (0..2) of triangle `triangle`.
  const Eigen::Vector3d& corner(std::int32_t triangle, int corner) const {
    return vertices[static_cast<std::size_t>(
        triangles[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(corner)])];
  }
};

}  // namespace glissade::collision

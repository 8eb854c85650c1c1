#pragma once

/// A triangle soup with shared vertices, and simple operations on meshes, such as merge, transform and weld. The
/// operations are pure functions that any thread may call. Their cost is linear in the size of the input.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>

namespace glissade::geometry {

/// Indices of a triangle's three vertices.
using Triangle = std::array<std::int32_t, 3>;

/// Triangles over an indexed set of vertices, in metres, in the frame of their object.
///
/// The surface may be open, non-manifold, self-intersecting and inconsistently oriented. Triangles may be degenerate.
/// Two triangles are adjacent only where they share vertex indices, so meshes should be welded. `import_mesh` welds
/// meshes.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;

  /// Corner `corner` (0..2) of triangle `triangle`.
  const Eigen::Vector3d& corner(std::int32_t triangle, int corner) const {
    return vertices[static_cast<std::size_t>(
        triangles[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(corner)])];
  }
  /// All three corners of triangle `triangle`.
  std::array<Eigen::Vector3d, 3> corners(std::int32_t triangle) const {
    return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
  }
};

/// All triangles of `meshes` as one mesh, in the order of the meshes. Vertices are copied, not welded, so the input
/// meshes stay separate components. Throws std::invalid_argument if the result would have more than 2^31 - 1 vertices.
GLISSADE_EXPORT TriangleMesh merge(std::span<const TriangleMesh> meshes);

/// The mesh `mesh_B`, transformed from coordinates of frame B to coordinates of frame A.
GLISSADE_EXPORT TriangleMesh transformed(const TriangleMesh& mesh_B, const Eigen::Isometry3d& X_AB);

/// A copy of the mesh in which the orientation of each triangle is reversed with probability one half. Equal seeds give
/// equal meshes. Tests use this function to check that nothing in this library depends on the orientation of triangles.
GLISSADE_EXPORT TriangleMesh flip_randomly(const TriangleMesh& mesh, std::uint64_t seed);

/// Merges vertices at identical positions (0 and -0 count as identical). Keeps all triangles, including degenerate
/// triangles, in their order. Drops vertices that no triangle uses. Numbers the other vertices in the order of first
/// use.
GLISSADE_EXPORT TriangleMesh weld(const TriangleMesh& mesh);

/// The axis-aligned bounding box of all vertices in the mesh's frame; empty without vertices.
GLISSADE_EXPORT Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh);

/// Indices of the triangles with all three corners in the box, in ascending order.
GLISSADE_EXPORT std::vector<std::int32_t> triangles_inside(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box);

/// Makes the given triangles (indices in ascending order) degenerate, i.e. of zero area, so that they take part in no
/// query. All other triangles keep their indices. Use this function if a part in its final position overlaps an
/// obstacle by design. Then remove those triangles of the obstacle that bend out of the way in reality, such as the
/// spring tongues in the slot of a car radio.
GLISSADE_EXPORT TriangleMesh without_triangles(const TriangleMesh& mesh, std::span<const std::int32_t> triangles);

}  // namespace glissade::geometry

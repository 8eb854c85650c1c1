#pragma once

/// A triangle soup with shared vertices, and small operations that make other meshes of it: merge, transform, weld.
/// The operations are pure functions; any thread may call them. Their cost is linear in the size of the input.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::geometry {

/// Indices of a triangle's three vertices.
using Triangle = std::array<std::int32_t, 3>;

/// Triangles over an indexed set of vertices, in metres, in the frame of the object they belong to.
///
/// Nothing is assumed of them: they may be open, non-manifold, self-intersecting, inconsistently oriented, and
/// degenerate. Two triangles are neighbors only where they share vertex indices, so meshes should be welded
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

/// All triangles of `meshes`, in order, as one mesh. Vertices are copied, not welded: parts stay separate components.
/// Throws std::invalid_argument when the result would have more than 2^31 - 1 vertices.
TriangleMesh merge(std::span<const TriangleMesh> meshes);

/// `mesh_B`, given in the frame B, in the frame A.
TriangleMesh transformed(const TriangleMesh& mesh_B, const Eigen::Isometry3d& X_AB);

/// The same triangles, each turned over with probability one half. Equal seeds give equal meshes. For tests: nothing in
/// this library may depend on the orientation of triangles.
TriangleMesh flip_randomly(const TriangleMesh& mesh, std::uint64_t seed);

/// Vertices at identical positions become one; 0 and -0 are the same position. Keeps every triangle, also those that
/// lose their area by it, in order; drops vertices that no triangle uses. Vertices are numbered by first use.
TriangleMesh weld(const TriangleMesh& mesh);

/// The triangles of the mesh that lie in the box with all of their corners, ascending.
std::vector<std::int32_t> triangles_inside(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box);

/// The mesh without some of its triangles, which are given in ascending order: they lose their area, so that they take
/// part in nothing, and all others keep their numbers. For parts that slide in and overlap by design when they are
/// seated, such as a unit on its spring tongues: what is to give way is taken out of the obstacle beforehand.
TriangleMesh without_triangles(const TriangleMesh& mesh, std::span<const std::int32_t> triangles);

}  // namespace glissade::geometry

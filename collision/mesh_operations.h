#pragma once

/// Small operations that turn meshes into other meshes: merging, moving, flipping, welding.
/// All are pure functions; any thread may call them. Cost is linear in the size of the input.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/triangle_mesh.h>

namespace glissade::collision {

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

}  // namespace glissade::collision

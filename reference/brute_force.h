#pragma once

/// Tests two meshes for intersection by brute force, i.e. every triangle of one mesh against every triangle of the
/// other. The result is a reference for comparison with faster queries. Use `dop_query.h` for all other purposes.
///
/// The exact predicate of `triangle_pair.h` decides each pair whose axis-aligned bounding boxes overlap. As in
/// `dop_query.h`, it takes the vertices of A, and the vertices of B transformed by X_AB in double precision. Triangles
/// of zero area are ignored. Touching counts as intersection. Cost O(n·m).

#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::reference {

/// Whether any two triangles intersect.
bool brute_force_intersects(const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B,
                            const Eigen::Isometry3d& X_AB);

/// Every intersecting pair of triangles, in ascending order.
std::vector<collision::TrianglePair> brute_force_pairs(const geometry::TriangleMesh& mesh_A,
                                                       const geometry::TriangleMesh& mesh_B,
                                                       const Eigen::Isometry3d& X_AB);

}  // namespace glissade::reference

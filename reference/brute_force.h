#pragma once

/// Intersection of two meshes without any hierarchy: every triangle of one against every triangle of the other. The
/// plain answer that faster queries are compared with; use `dop_query.h` for work.
///
/// Pairs whose boxes are apart are dropped; the others go through the exact predicate of `triangle_pair.h`, on
/// the same coordinates as in `dop_query.h`: the vertices of A, and those of B after X_AB in double precision. Only
/// triangles of positive area take part; touching counts. Cost O(n·m).

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

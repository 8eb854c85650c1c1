#pragma once

/// Intersection of two meshes by brute force: every triangle of one against every triangle of the other. A reference
/// that faster queries are compared with; use `dop_query.h` for all other purposes.
///
/// Pairs with disjoint axis-aligned bounding boxes are skipped; the others are decided by the exact predicate of
/// `triangle_pair.h`. The coordinates are the same as in `dop_query.h`: the vertices of A, and the vertices of B
/// transformed by X_AB in double precision. Only triangles of positive area take part; touching counts. Cost O(n·m).

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

#pragma once

/// Encloses the vertices of a mesh by the boxes and thin slabs of a tree, from the leaves up.

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

#include "tree/dop_node.h"

namespace glissade::collision {

/// Where the grid of a tree lies.
struct TreeGrid {
  Eigen::Vector3d center;
  Eigen::Vector3d half_size;
  double radius;
};

/// The bounding box of all corners, rounded outward, and the radius about its centre.
TreeGrid grid_of(const geometry::TriangleMesh& mesh);

/// Fills the corners of all leaves, and marks triangles without area; returns their number. No allocation.
std::int64_t fit_leaves(const geometry::TriangleMesh& mesh, const TreeGrid& grid, std::span<TriangleLeaf> leaves);

/// Fills the boxes of all nodes, of k = `directions`, and, where asked for, their thin slabs. No allocation. Cost O(n
/// log n).
void fit_nodes(int directions, bool thin_slab, std::span<const TriangleLeaf> leaves, std::span<NodeHead> heads,
               std::span<SlabLine> slabs);

}  // namespace glissade::collision

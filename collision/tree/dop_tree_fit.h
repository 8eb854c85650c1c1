#pragma once

/// Fits the boxes and thin slabs of a tree to the vertices of a mesh, from the leaves up.

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

#include "tree/dop_node.h"

namespace glissade::collision {

/// The grid of a tree, in the frame of its mesh, metres.
struct TreeGrid {
  Eigen::Vector3d center;
  Eigen::Vector3d half_size;
  double radius;
};

/// The axis-aligned bounding box of all corners, rounded outward, and the radius of a sphere about its centre that
/// encloses them.
TreeGrid grid_of(const geometry::TriangleMesh& mesh);

/// Sets the corners of all leaves and marks triangles without area. Returns the number of triangles without area.
/// Allocates nothing.
std::int64_t fit_leaves(const geometry::TriangleMesh& mesh, const TreeGrid& grid, std::span<TriangleLeaf> leaves);

/// Sets the DOPs of all nodes, with k = `directions`, and their thin slabs if `thin_slab` is true. Allocates nothing.
/// Cost O(n log n).
void fit_nodes(int directions, bool thin_slab, std::span<const TriangleLeaf> leaves, std::span<NodeHead> heads,
               std::span<SlabLine> slabs);

}  // namespace glissade::collision

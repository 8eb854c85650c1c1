#pragma once

/// The shape of a DOP-tree: which triangles share a leaf, and which leaves share a node. `dop_tree_fit.h` computes the
/// boxes.
///
/// A set of triangles is split in two by the surface-area heuristic (Goldsmith and Salmon 1987; binned after Wald
/// 2007), then the part of larger area again, until there are four parts. The area of a part estimates how often it is
/// visited. The cost of a visit is estimated by the number of triangles, in whole leaves of four and whole nodes of
/// four leaves.

#include <vector>

#include <glissade/geometry/triangle_mesh.h>

#include "tree/dop_node.h"

namespace glissade::collision {

/// Nodes with their children, leaves with their triangles; no other members are set. All leaves below a node are
/// consecutive and begin with its `first_leaf`.
struct TreeShape {
  std::vector<NodeHead> nodes;
  std::vector<TriangleLeaf> leaves;
  int depth = 0;
};

/// Builds the shape, with several threads if the mesh is large. The result does not depend on their number. Cost O(n
/// log n).
TreeShape build_shape(const geometry::TriangleMesh& mesh);

}  // namespace glissade::collision

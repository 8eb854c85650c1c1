#pragma once

/// The shape of a DOP-tree: which triangles share a leaf, and which leaves a node. Where the boxes lie is found by
/// `dop_tree_fit.h`.
///
/// A run of triangles is split in two where a surface-area heuristic says so (Goldsmith and Salmon 1987; binned after
/// Wald 2007), the larger part again, until there are four. Areas count how often a part is visited, and numbers of
/// triangles, in whole leaves of four and whole nodes of four leaves, what that costs.

#include <vector>

#include <glissade/geometry/triangle_mesh.h>

#include "tree/dop_node.h"

namespace glissade::collision {

/// Nodes with their children, leaves with their triangles; nothing else of either is set. The leaves below a node are
/// consecutive, beginning with its `first_leaf`.
struct TreeShape {
  std::vector<NodeHead> nodes;
  std::vector<TriangleLeaf> leaves;
  int depth = 0;
};

/// Runs on several threads when the mesh is large; the result does not depend on their number. Cost O(n log n).
TreeShape build_shape(const geometry::TriangleMesh& mesh);

}  // namespace glissade::collision

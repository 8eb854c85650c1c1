#pragma once

/// The nodes and leaves of a DOP-tree as kernels read them, inline.

#include <cstdint>
#include <memory>
#include <span>

#include <glissade/collision/dop_tree.h>

#include "tree/dop_node.h"
#include "tree/dop_tree_build.h"
#include "tree/dop_vertices.h"

namespace glissade::collision {

static_assert(DopTree::kWidth == kWidth);

/// Node 0 is the root; it has at least one child.
inline std::span<const NodeHead> DopTree::nodes() const {
  return heads_;
}

/// The offsets of a node's children.
inline const SlabLine* DopTree::slabs(std::uint32_t node) const {
  return &slabs_[node * lines_of_node_];
}

/// The same as vertices; of trees realigned by brute force only.
inline std::span<const VertexGroup> DopTree::vertices(std::uint32_t node) const {
  return vertices_->of(node);
}

inline std::span<const TriangleLeaf> DopTree::leaves() const {
  return leaves_;
}

/// The tree of a shape that was built before, for the same number of triangles. Throws as DopTree does.
DopTree tree_of_shape(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options,
                      TreeShape&& shape);

}  // namespace glissade::collision

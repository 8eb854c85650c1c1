#pragma once

/// Inline access to the nodes and leaves of a DOP-tree, for kernels.

#include <cstdint>
#include <memory>
#include <span>

#include <glissade/collision/dop_tree.h>

#include "tree/dop_node.h"
#include "tree/dop_tree_build.h"
#include "tree/dop_vertices.h"

namespace glissade::collision {

static_assert(DopTree::kWidth == kWidth);

/// Gives the component access to the members of a tree; users see `DopTree::node` only.
struct TreeNodes {
  static std::span<const NodeHead> heads(const DopTree& tree) { return tree.heads_; }
  static const SlabLine* slabs(const DopTree& tree, std::uint32_t node) {
    return &tree.slabs_[node * tree.lines_of_node_];
  }
  static std::span<const VertexGroup> vertices(const DopTree& tree, std::uint32_t node) {
    return tree.vertices_->of(node);
  }
  static std::span<const TriangleLeaf> leaves(const DopTree& tree) { return tree.leaves_; }
};

/// The nodes of a tree. Node 0 is the root; it has at least one child.
inline std::span<const NodeHead> nodes_of(const DopTree& tree) {
  return TreeNodes::heads(tree);
}

/// The slabs of a node's children.
inline const SlabLine* slabs_of(const DopTree& tree, std::uint32_t node) {
  return TreeNodes::slabs(tree, node);
}

/// The vertices of the DOPs of a node's children; only for trees of `Realignment::kBruteForce`.
inline std::span<const VertexGroup> vertices_of(const DopTree& tree, std::uint32_t node) {
  return TreeNodes::vertices(tree, node);
}

inline std::span<const TriangleLeaf> leaves_of(const DopTree& tree) {
  return TreeNodes::leaves(tree);
}

/// The tree of a shape that was built before, for a mesh with the same number of triangles. Throws as the constructor
/// of DopTree does.
DopTree tree_of_shape(std::shared_ptr<const geometry::TriangleMesh> mesh, const DopTreeOptions& options,
                      TreeShape&& shape);

}  // namespace glissade::collision

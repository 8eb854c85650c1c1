#pragma once

/// The triangles below a node or a child of a DOP-tree, by traversal.

#include <cstdint>
#include <vector>

#include <glissade/collision/dop_tree.h>

#include "tree/tree_nodes.h"

namespace glissade::test_support {

/// Adds the triangles of a leaf that have an area.
inline void add_triangles_of_leaf(const collision::DopTree& tree, std::uint32_t leaf,
                                  std::vector<std::int32_t>& triangles) {
  for (const std::int32_t triangle : leaves_of(tree)[leaf].triangle) {
    if (triangle >= 0) triangles.push_back(triangle);
  }
}

/// The same for all leaves below a node.
inline void add_triangles_of_node(const collision::DopTree& tree, std::uint32_t node,
                                  std::vector<std::int32_t>& triangles) {
  const collision::NodeHead& head = nodes_of(tree)[node];
  for (int c = 0; c < head.child_count(); ++c) {
    if (head.is_leaf(c)) {
      add_triangles_of_leaf(tree, head.child(c), triangles);
    } else {
      add_triangles_of_node(tree, head.child(c), triangles);
    }
  }
}

/// The triangles below a child of a node that have an area.
inline std::vector<std::int32_t> triangles_below(const collision::DopTree& tree, std::uint32_t node, int child) {
  const collision::NodeHead& head = nodes_of(tree)[node];
  std::vector<std::int32_t> triangles;
  if (head.is_leaf(child)) {
    add_triangles_of_leaf(tree, head.child(child), triangles);
  } else {
    add_triangles_of_node(tree, head.child(child), triangles);
  }
  return triangles;
}

}  // namespace glissade::test_support

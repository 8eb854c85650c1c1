#pragma once

/// What a DOP-tree holds below a place, by going there.

#include <cstdint>
#include <vector>

#include <glissade/collision/dop_tree.h>

#include "tree/tree_nodes.h"

namespace glissade::test_support {

/// Adds the triangles with an area of a leaf.
inline void add_triangles_of_leaf(const collision::DopTree& tree, std::uint32_t leaf,
                                  std::vector<std::int32_t>& triangles) {
  for (const std::int32_t triangle : tree.leaves()[leaf].triangle) {
    if (triangle >= 0) triangles.push_back(triangle);
  }
}

/// The same of all leaves below a node.
inline void add_triangles_of_node(const collision::DopTree& tree, std::uint32_t node,
                                  std::vector<std::int32_t>& triangles) {
  const collision::NodeHead& head = tree.nodes()[node];
  for (int c = 0; c < head.child_count(); ++c) {
    if (head.is_leaf(c)) {
      add_triangles_of_leaf(tree, head.child(c), triangles);
    } else {
      add_triangles_of_node(tree, head.child(c), triangles);
    }
  }
}

/// The triangles with an area below a child of a node.
inline std::vector<std::int32_t> triangles_below(const collision::DopTree& tree, std::uint32_t node, int child) {
  const collision::NodeHead& head = tree.nodes()[node];
  std::vector<std::int32_t> triangles;
  if (head.is_leaf(child)) {
    add_triangles_of_leaf(tree, head.child(child), triangles);
  } else {
    add_triangles_of_node(tree, head.child(child), triangles);
  }
  return triangles;
}

}  // namespace glissade::test_support

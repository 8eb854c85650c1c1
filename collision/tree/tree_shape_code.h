#pragma once

/// Serialisation of the shape of a DOP-tree. Each shape has exactly one code. Links between nodes are not stored but
/// derived, so every code that can be decoded is a tree.
///
/// Nodes come in the order of `TreeShape`: the root, then for each node of a depth-first walk its children that are
/// nodes. Numbers are little-endian.
///
///   4 bytes             number of nodes
///   4 bytes             number of leaves
///   1 byte a node       16 · number of children that are nodes + number of children that are leaves
///   1 byte a leaf       number of triangles
///   4 bytes a triangle  its index, leaf by leaf

#include <string>
#include <string_view>

#include <glissade/collision/dop_tree.h>

#include "tree/dop_tree_build.h"

namespace glissade::collision {

/// Appends the code of a tree's shape.
void append_shape_code(const DopTree& tree, std::string& bytes);

/// Upper bound of the length of a shape code in bytes, for a tree over that number of triangles.
std::size_t longest_shape_code(std::size_t triangles);

/// Decodes a shape in which each of `triangles` triangles is in exactly one leaf. Throws std::invalid_argument, with a
/// reason in a few words, for anything else.
TreeShape decode_shape(std::string_view bytes, std::size_t triangles);

}  // namespace glissade::collision

#pragma once

/// The shape of a DOP-tree as bytes. There is one code for each shape, and links follow from it, so that what can be
/// decoded at all is a tree.
///
/// Nodes come in the order of `TreeShape`: the root, then for every node, in a depth-first walk, those of its children
/// that are nodes. Numbers are stored lowest byte first.
///
///   4 bytes             nodes
///   4 bytes             leaves
///   1 byte a node       16 · children that are nodes + children that are leaves
///   1 byte a leaf       triangles
///   4 bytes a triangle  its index, leaf by leaf

#include <string>
#include <string_view>

#include <glissade/collision/dop_tree.h>

#include "tree/dop_tree_build.h"

namespace glissade::collision {

/// Appends the code of a tree's shape.
void append_shape_code(const DopTree& tree, std::string& bytes);

/// No code of a tree over so many triangles is longer.
std::size_t longest_shape_code(std::size_t triangles);

/// Decodes a shape over `triangles` triangles, each of which stands in exactly one leaf. Throws std::invalid_argument,
/// in a few words, for anything else.
TreeShape decode_shape(std::string_view bytes, std::size_t triangles);

}  // namespace glissade::collision

#pragma once

/// Asks for memory before it is needed.

#include <cstddef>
#include <cstdint>

#include <hwy/cache_control.h>

#include <glissade/collision/dop_tree.h>

#include "tree/tree_nodes.h"

namespace glissade::collision {

/// The cache lines of some bytes.
template <typename Value>
void prefetch_lines(const Value* values, std::size_t bytes) {
  for (std::size_t line = 0; line < bytes; line += 64)
    hwy::Prefetch(reinterpret_cast<const char*>(values) + line);
}

/// What a visit of this node will look at.
inline void prefetch_node(const DopTree& tree, std::uint32_t node) {
  prefetch_lines(&tree.nodes()[node], 1);
  prefetch_lines(tree.slabs(node), 64 * static_cast<std::size_t>(slab_lines(tree.options().directions / 2)));
}

}  // namespace glissade::collision

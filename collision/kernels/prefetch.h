#pragma once

/// Prefetches parts of a tree.

#include <cstddef>
#include <cstdint>

#include <hwy/cache_control.h>

#include <glissade/collision/dop_tree.h>

#include "tree/tree_nodes.h"

namespace glissade::collision {

/// Prefetches the cache lines of `bytes` bytes from `values` on.
template <typename Value>
void prefetch_lines(const Value* values, std::size_t bytes) {
  for (std::size_t line = 0; line < bytes; line += 64)
    hwy::Prefetch(reinterpret_cast<const char*>(values) + line);
}

/// Prefetches all memory that a visit of this node reads.
inline void prefetch_node(const DopTree& tree, std::uint32_t node) {
  prefetch_lines(&nodes_of(tree)[node], 1);
  prefetch_lines(slabs_of(tree, node), 64 * static_cast<std::size_t>(slab_lines(tree.options().directions / 2)));
}

}  // namespace glissade::collision

#pragma once

/// Whether two trees are the same to the last bit.

#include <algorithm>
#include <cstring>
#include <span>

#include <gtest/gtest.h>

#include <glissade/collision/dop_tree.h>

#include "tree/tree_nodes.h"

namespace glissade::collision {

template <typename Part>
bool same_bytes(std::span<const Part> a, std::span<const Part> b) {
  static_assert(std::is_trivially_copyable_v<Part>);
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

inline std::span<const SlabLine> all_slabs(const DopTree& tree) {
  const auto lines = static_cast<std::size_t>(slab_lines(dop_directions(tree.options().directions).slabs));
  return {slabs_of(tree, 0), nodes_of(tree).size() * lines};
}

inline void expect_same_tree(const DopTree& a, const DopTree& b) {
  EXPECT_EQ(a.options(), b.options());
  EXPECT_TRUE(same_bytes(nodes_of(a), nodes_of(b)));
  EXPECT_TRUE(same_bytes(leaves_of(a), leaves_of(b)));
  EXPECT_TRUE(same_bytes(all_slabs(a), all_slabs(b)));
  EXPECT_EQ(a.degenerate_triangles(), b.degenerate_triangles());
  EXPECT_EQ(a.depth(), b.depth());
  EXPECT_EQ(a.center(), b.center());
  EXPECT_EQ(a.radius(), b.radius());
  EXPECT_EQ(a.memory_bytes(), b.memory_bytes());
}

}  // namespace glissade::collision

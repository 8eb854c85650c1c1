#pragma once

/// The vertices of the DOPs of all nodes, for realignment by brute force (paper §2.1.1). Only trees of
/// `Realignment::kBruteForce` keep them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tree/dop.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// Four vertices of each of the four children of a node.
struct alignas(64) VertexGroup {
  std::array<std::array<float, 4 * kWidth>, 3> coordinate;  ///< [axis][4 · vertex + child], in grid steps
};

/// Maximum number of vertices of a DOP of k half-spaces. It is reached if every vertex lies on exactly three planes.
constexpr int most_vertices(int k) {
  return 2 * k - 4;
}

/// The vertices of all nodes of a tree.
class DopVertices {
 public:
  DopVertices() = default;
  DopVertices(int k, std::size_t nodes);

  /// Computes the vertices of all nodes from the heads and slabs of the tree. Allocates nothing. Cost O(k³) a node.
  ///
  /// The convex hull of the vertices encloses the DOP except for rounding to single precision: each coordinate may be
  /// off by half a unit in its last place. The hull is larger than the DOP by a few hundredths of a grid step at most.
  void fit(std::span<const NodeHead> heads, std::span<const SlabLine> slabs);

  /// The vertices of the children of a node: as many groups as the child with most vertices needs. Unused lanes repeat
  /// a vertex.
  std::span<const VertexGroup> of(std::uint32_t node) const { return {&groups_[node * stride_], counts_[node]}; }

  std::size_t memory_bytes() const { return groups_.capacity() * sizeof(VertexGroup) + counts_.capacity(); }

 private:
  int k_ = 0;
  std::size_t stride_ = 0;
  std::vector<VertexGroup> groups_;
  std::vector<std::uint8_t> counts_;
};

}  // namespace glissade::collision

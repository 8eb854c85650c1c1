#pragma once

/// Nodes as the vertices of their DOPs, for realignment by brute force (paper §2.1.1). Only trees of
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

/// Vertices of a DOP of k half-spaces: so many when every vertex lies on three planes, fewer otherwise.
constexpr int most_vertices(int k) {
  return 2 * k - 4;
}

/// The vertices of all nodes of a tree.
class DopVertices {
 public:
  DopVertices() = default;
  DopVertices(int k, std::size_t nodes);

  /// Finds the vertices of all nodes, `slabs` as in the tree. Allocates nothing. Cost O(k³) a node.
  ///
  /// Their hull holds the DOP but for the rounding to single precision: each may be off by half a unit in the last
  /// place of its coordinates. It is larger than the DOP by a few hundredths of a grid step at most.
  void fit(std::span<const NodeHead> heads, std::span<const SlabLine> slabs);

  /// As many groups as the child of most vertices needs; lanes left over repeat a vertex.
  std::span<const VertexGroup> of(std::uint32_t node) const { return {&groups_[node * stride_], counts_[node]}; }

  std::size_t memory_bytes() const { return groups_.capacity() * sizeof(VertexGroup) + counts_.capacity(); }

 private:
  int k_ = 0;
  std::size_t stride_ = 0;
  std::vector<VertexGroup> groups_;
  std::vector<std::uint8_t> counts_;
};

}  // namespace glissade::collision

#pragma once

/// Some triangles of a mesh, marked in its DOP-tree, for queries that are after pairs with one of these: so a query of
/// contacts need not look at where faces lie flush, of which only rims can stop anything.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

/// Which children of each node hold selected triangles, and which triangles of each leaf are selected: a byte for each.
/// Immutable after construction, so safe to share between threads.
class TriangleSelection {
 public:
  /// Asks `is_selected` once for every triangle, by its number in the mesh. Serves the tree
  /// that it was made for, also after a refit, and copies of it. Cost O(n).
  TriangleSelection(const DopTree& tree, const std::function<bool(std::int32_t)>& is_selected);

  /// By node: bit c, whether there is a selected triangle below its child c.
  std::span<const std::uint8_t> nodes() const { return nodes_; }
  /// By leaf: bit t, whether its triangle t is selected.
  std::span<const std::uint8_t> leaves() const { return leaves_; }

  /// Whether the selection can be of a tree, by the numbers of its nodes and leaves.
  bool is_of(const DopTree& tree) const {
    return nodes_.size() == tree.nodes().size() && leaves_.size() == tree.leaves().size();
  }

  /// Another number for every selection of this process, from 1. Copies have the same.
  std::uint64_t id() const { return id_; }

 private:
  std::vector<std::uint8_t> nodes_;
  std::vector<std::uint8_t> leaves_;
  std::uint64_t id_;
};

/// A query of two trees with this answers those pairs of triangles of which at least one is selected. Without a
/// selection all triangles of a tree count as selected, so that both are needed to leave anything out.
struct PairSelection {
  const TriangleSelection* of_A = nullptr;
  const TriangleSelection* of_B = nullptr;
};

}  // namespace glissade::collision

#pragma once

/// The pairs of the children of two nodes, or of the triangles of two leaves, that hold selected pairs of triangles.

#include <array>
#include <cstdint>
#include <stdexcept>

#include <glissade/collision/query_types.h>

#include "kernels/child_pairs.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {

/// All pairs of one child of M, and of one of N.
constexpr PairMask row_of(int child_M) {
  return 0xfU << (kWidth * child_M);
}
constexpr PairMask column_of(int child_N) {
  return 0x1111U << child_N;
}

/// For each set of children of M (one bit per child), all pairs with these children.
inline constexpr auto kRowsOf = [] {
  std::array<std::uint16_t, 1U << kWidth> rows{};
  for (std::uint32_t children = 0; children < rows.size(); ++children) {
    for (int c = 0; c < kWidth; ++c)
      rows[children] |= static_cast<std::uint16_t>((children >> c & 1U) != 0 ? row_of(c) : 0);
  }
  return rows;
}();

/// All pairs with a set of children.
constexpr PairMask rows_of(std::uint32_t children_M) {
  return kRowsOf[children_M];
}
constexpr PairMask columns_of(std::uint32_t children_N) {
  return children_N * column_of(0);
}

/// The selections of both trees, by their roles M and N in a query.
class VisitSelection {
 public:
  /// Selects all pairs.
  VisitSelection() = default;

  /// Selects the pairs in which either side is selected, or both are half selected; all pairs if one selection is null.
  /// Throws std::invalid_argument for a selection that cannot belong to its tree.
  VisitSelection(const DopTree& base, const DopTree& other, const TriangleSelection* of_M,
                 const TriangleSelection* of_N) {
    check(base, of_M);
    check(other, of_N);
    if (of_M == nullptr || of_N == nullptr) return;
    of_M_ = of_M;
    of_N_ = of_N;
  }

  PairMask pairs_of_nodes(std::uint32_t node_M, std::uint32_t node_N) const {
    if (of_M_ == nullptr) return kAllPairs;
    return pairs(of_M_->selected().nodes[node_M], of_M_->at_least_half().nodes[node_M], of_N_->selected().nodes[node_N],
                 of_N_->at_least_half().nodes[node_N]);
  }
  PairMask pairs_of_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N) const {
    if (of_M_ == nullptr) return kAllPairs;
    return pairs(of_M_->selected().leaves[leaf_M], of_M_->at_least_half().leaves[leaf_M],
                 of_N_->selected().leaves[leaf_N], of_N_->at_least_half().leaves[leaf_N]);
  }

  /// Numbers of the selections, 0 where there are none.
  std::array<std::uint64_t, 2> ids() const {
    return of_M_ == nullptr ? std::array<std::uint64_t, 2>{} : std::array{of_M_->id(), of_N_->id()};
  }

 private:
  static PairMask pairs(std::uint32_t selected_M, std::uint32_t half_M, std::uint32_t selected_N,
                        std::uint32_t half_N) {
    return rows_of(selected_M) | columns_of(selected_N) | (rows_of(half_M) & columns_of(half_N));
  }
  static void check(const DopTree& tree, const TriangleSelection* selection) {
    if (selection == nullptr || selection->is_of(tree)) return;
    throw std::invalid_argument("a selection of triangles was made for another tree than that of the query");
  }

  const TriangleSelection* of_M_ = nullptr;  ///< both or none
  const TriangleSelection* of_N_ = nullptr;
};

}  // namespace glissade::collision

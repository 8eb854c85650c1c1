#pragma once

/// Which pairs of the children of two nodes, or of the triangles of two leaves, have something that was selected.

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

/// For each set of children of M, a bit for each, its pairs with any child of N.
inline constexpr auto kRowsOf = [] {
  std::array<std::uint16_t, 1U << kWidth> rows{};
  for (std::uint32_t children = 0; children < rows.size(); ++children) {
    for (int c = 0; c < kWidth; ++c)
      rows[children] |= static_cast<std::uint16_t>((children >> c & 1U) != 0 ? row_of(c) : 0);
  }
  return rows;
}();

/// The pairs of a set of children.
constexpr PairMask rows_of(std::uint32_t children_M) {
  return kRowsOf[children_M];
}
constexpr PairMask columns_of(std::uint32_t children_N) {
  return children_N * column_of(0);
}

/// The selections of both trees where they lie, in the roles that these have in a query.
class VisitSelection {
 public:
  /// All pairs.
  VisitSelection() = default;

  /// The pairs with something of either selection; all of them where one is null. Throws std::invalid_argument for a
  /// selection that cannot be of its tree.
  VisitSelection(const DopTree& base, const DopTree& other, const TriangleSelection* of_M,
                 const TriangleSelection* of_N) {
    check(base, of_M);
    check(other, of_N);
    if (of_M == nullptr || of_N == nullptr) return;
    of_P_ = of_M;
    of_Q_ = of_N;
  }

  PairMask pairs_of_nodes(std::uint32_t node_M, std::uint32_t node_N) const {
    return of_P_ == nullptr ? kAllPairs : rows_of(of_P_->nodes()[node_M]) | columns_of(of_Q_->nodes()[node_N]);
  }
  PairMask pairs_of_leaves(std::uint32_t leaf_M, std::uint32_t leaf_N) const {
    return of_P_ == nullptr ? kAllPairs : rows_of(of_P_->leaves()[leaf_M]) | columns_of(of_Q_->leaves()[leaf_N]);
  }

  /// Numbers of the selections, 0 where there are none.
  std::array<std::uint64_t, 2> ids() const {
    return of_P_ == nullptr ? std::array<std::uint64_t, 2>{} : std::array{of_P_->id(), of_Q_->id()};
  }

 private:
  static void check(const DopTree& tree, const TriangleSelection* selection) {
    if (selection == nullptr || selection->is_of(tree)) return;
    throw std::invalid_argument("a selection of triangles was made for another tree than that of the query");
  }

  const TriangleSelection* of_P_ = nullptr;  ///< both or none
  const TriangleSelection* of_Q_ = nullptr;
};

}  // namespace glissade::collision

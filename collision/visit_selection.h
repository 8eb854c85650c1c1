#pragma once

/// Which pairs of the children of two nodes, or of the triangles of two leaves, have something that was selected.

#include <array>
#include <cstdint>
#include <stdexcept>

#include <glissade/collision/triangle_selection.h>

#include "node_kernels.h"

namespace glissade::collision {

/// All pairs of one child of P, and of one of Q.
constexpr PairMask row_of(int child_P) {
  return 0xfU << (kWidth * child_P);
}
constexpr PairMask column_of(int child_Q) {
  return 0x1111U << child_Q;
}

/// For each set of children of P, a bit for each, its pairs with any child of Q.
inline constexpr auto kRowsOf = [] {
  std::array<std::uint16_t, 1U << kWidth> rows{};
  for (std::uint32_t children = 0; children < rows.size(); ++children) {
    for (int c = 0; c < kWidth; ++c)
      rows[children] |= static_cast<std::uint16_t>((children >> c & 1U) != 0 ? row_of(c) : 0);
  }
  return rows;
}();

/// The pairs of a set of children.
constexpr PairMask rows_of(std::uint32_t children_P) {
  return kRowsOf[children_P];
}
constexpr PairMask columns_of(std::uint32_t children_Q) {
  return children_Q * column_of(0);
}

/// The selections of both trees where they lie, in the roles that these have in a query.
class VisitSelection {
 public:
  /// All pairs.
  VisitSelection() = default;

  /// The pairs with something of either selection; all of them where one is null. Throws std::invalid_argument for a
  /// selection that cannot be of its tree.
  VisitSelection(const DopTree& base, const DopTree& other, const TriangleSelection* of_P,
                 const TriangleSelection* of_Q) {
    check(base, of_P);
    check(other, of_Q);
    if (of_P == nullptr || of_Q == nullptr) return;
    of_P_ = of_P;
    of_Q_ = of_Q;
  }

  PairMask pairs_of_nodes(std::uint32_t node_P, std::uint32_t node_Q) const {
    return of_P_ == nullptr ? kAllPairs : rows_of(of_P_->nodes()[node_P]) | columns_of(of_Q_->nodes()[node_Q]);
  }
  PairMask pairs_of_leaves(std::uint32_t leaf_P, std::uint32_t leaf_Q) const {
    return of_P_ == nullptr ? kAllPairs : rows_of(of_P_->leaves()[leaf_P]) | columns_of(of_Q_->leaves()[leaf_Q]);
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

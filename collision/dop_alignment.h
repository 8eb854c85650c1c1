#pragma once

/// Realignment (paper §2.1, eq. 1): encloses the tumbled nodes of tree B by DOPs aligned to the frame of tree A, each
/// new plane offset being a combination of three old ones. The correspondence is found once per query; a node costs
/// O(k).

#include <array>
#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/collision/dop.h>

namespace glissade::collision {

/// The correspondence for one pose.
///
/// It cannot make a DOP too small: for weights w ≥ 0 with Σ w_l b_l = c, the sum Σ w_l support[l] bounds c·x over every
/// DOP whatever the half-spaces l (linear-programming duality), so a poor choice of l costs tightness only. What
/// rounding takes away is added back as a constant per half-space.
class DopAlignment {
 public:
  /// For nodes of a tree whose coordinates do not exceed `largest_coordinate_B` (metres), tested against nodes of a
  /// tree whose coordinates do not exceed `largest_coordinate_A`.
  DopAlignment(const Eigen::Isometry3d& X_AB, double largest_coordinate_A, double largest_coordinate_B);

  /// The aligned DOP, in A, that encloses `dop_B` placed at X_AB.
  Dop realign(const Dop& dop_B) const {
    Dop aligned;
    for (std::size_t i = 0; i < kDopDirections; ++i) {
      const Row& row = rows_[i];
      aligned.support[i] = row.weights[0] * dop_B.support[row.half_spaces[0]] +
                           row.weights[1] * dop_B.support[row.half_spaces[1]] +
                           row.weights[2] * dop_B.support[row.half_spaces[2]] + row.offset;
    }
    return aligned;
  }

 private:
  struct Row {
    std::array<float, 3> weights;
    std::array<std::uint8_t, 3> half_spaces;
    float offset;
  };
  std::array<Row, kDopDirections> rows_;
};

/// Thresholds for `disjoint`, from a distance in metres: how far two DOPs must be apart along each direction.
std::array<float, kDopDirections> separation_thresholds(double distance);

/// Whether some slab proves that everything inside `a` is further from everything inside `b` than the distance of
/// `separation`. Both DOPs in one frame.
inline bool disjoint(const Dop& a, const Dop& b, const std::array<float, kDopDirections>& separation) {
  bool apart = false;  // no early exit: the compiler makes vector code of this
  for (std::size_t i = 0; i < kDopSlabs; ++i) {
    apart |= a.support[i] + b.support[i + kDopSlabs] < -separation[i];
    apart |= a.support[i + kDopSlabs] + b.support[i] < -separation[i];
  }
  return apart;
}

}  // namespace glissade::collision

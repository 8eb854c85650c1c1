#pragma once

/// The discretely oriented polytope (DOP): the intersection of k half-spaces of fixed directions (paper §2.1).

#include <array>

#include <Eigen/Core>

namespace glissade::collision {

/// Maximum number of slabs (pairs of opposite half-spaces) of a DOP.
inline constexpr int kMostSlabs = 13;

/// The directions of a k-DOP. Half-space i < slabs has direction i; half-space i + slabs has the opposite direction.
///
/// All are symmetry axes of a cube, in this order: the 3 coordinate axes, the 6 edge directions, the corner directions.
/// k = 14 has axes and corners only. Directions spread by repulsion perform worse on machined objects, whose faces are
/// parallel to the axes.
struct DopDirections {
  int slabs;                                           ///< k / 2
  std::array<std::array<int, 3>, kMostSlabs> integer;  ///< not normalised
  std::array<Eigen::Vector3d, kMostSlabs> unit;

  /// Unit direction of half-space i, 0 ≤ i < 2 · slabs.
  Eigen::Vector3d half_space(int i) const {
    return i < slabs ? unit[static_cast<std::size_t>(i)] : Eigen::Vector3d(-unit[static_cast<std::size_t>(i - slabs)]);
  }
  /// The half-space opposite to half-space i.
  int opposite(int i) const { return i < slabs ? i + slabs : i - slabs; }
};

/// The supported numbers of half-spaces k.
inline constexpr std::array<int, 5> kDopSizes{6, 14, 18, 24, 26};

/// Index of k in kDopSizes. Throws std::invalid_argument for another k.
std::size_t dop_size_index(int k);

/// The directions for k = 6, 14, 18, 24 or 26. Throws std::invalid_argument for another k. Thread-safe.
const DopDirections& dop_directions(int k);

}  // namespace glissade::collision

#pragma once

/// The discretely oriented polytope (DOP): the intersection of k half-spaces of fixed directions (paper §2.1).

#include <array>

#include <Eigen/Core>

namespace glissade::collision {

/// Most pairs of opposite half-spaces ("slabs") a DOP of this library may have.
inline constexpr int kMostSlabs = 13;

/// The directions of a k-DOP. Half-space i < slabs has direction i, half-space i + slabs its opposite.
///
/// All are taken from the 13 symmetry axes of a cube: the 3 axes come first in every set, then the 6 edge directions,
/// then the corner directions; k = 14 has axes and corners only. Directions spread by repulsion lose on
/// machined objects, whose faces are parallel to the axes.
struct DopDirections {
  int slabs;                                           ///< k / 2
  std::array<std::array<int, 3>, kMostSlabs> integer;  ///< not normalised
  std::array<Eigen::Vector3d, kMostSlabs> unit;

  /// Unit direction of half-space i, 0 ≤ i < 2 · slabs.
  Eigen::Vector3d half_space(int i) const {
    return i < slabs ? unit[static_cast<std::size_t>(i)] : Eigen::Vector3d(-unit[static_cast<std::size_t>(i - slabs)]);
  }
  /// The half-space that faces the other way.
  int opposite(int i) const { return i < slabs ? i + slabs : i - slabs; }
};

/// The sets there are: k = 6, 14, 18, 24 and 26.
inline constexpr std::array<int, 5> kDopSizes{6, 14, 18, 24, 26};

/// Place of k in kDopSizes. Throws std::invalid_argument for another k.
std::size_t dop_size_index(int k);

/// The set for k = 6, 14, 18, 24 or 26. Throws std::invalid_argument for another k. Thread-safe.
const DopDirections& dop_directions(int k);

}  // namespace glissade::collision

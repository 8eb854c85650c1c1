#pragma once

/// The generic DOP of paper §2.1: one polytope in which every half-space supports a face and every vertex lies on
/// exactly three planes. Its vertices tell, for any direction, which three half-spaces bound it best in *every* DOP.

#include <array>
#include <vector>

#include <Eigen/Core>

namespace glissade::collision {

/// A vertex of the generic DOP.
struct GenericVertex {
  Eigen::Vector3d position;
  std::array<int, 3> half_spaces;        ///< the planes it lies on
  Eigen::Matrix3d weights_of_direction;  ///< maps a direction c to the w with Σ w_l dop_direction(half_spaces[l]) = c
};

/// The 44 vertices (a simple polytope of 24 faces has 2·24 − 4), computed once per process. Thread-safe.
const std::vector<GenericVertex>& generic_dop_vertices();

}  // namespace glissade::collision

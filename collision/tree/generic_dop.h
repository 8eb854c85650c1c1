#pragma once

/// The generic DOP of paper §2.1: one polytope in which every half-space supports a face and every vertex lies on
/// exactly three planes. Its vertices tell, for any direction, which three half-spaces bound it best in *every* DOP.

#include <array>
#include <vector>

#include <Eigen/Core>

namespace glissade::collision {

/// A vertex of the generic DOP. Its mirror image through the origin is one too, on the opposite planes.
struct GenericVertex {
  Eigen::Vector3d position;
  std::array<int, 3> half_spaces;        ///< the planes it lies on
  Eigen::Matrix3d weights_of_direction;  ///< maps a direction c to the w with Σ w_l b_l = c, b_l of unit length
};

/// One of each pair of mirrored vertices: k − 2 of 2k − 4, computed once per k and process. k as for `dop_directions`.
/// Thread-safe.
const std::vector<GenericVertex>& generic_dop_vertices(int k);

}  // namespace glissade::collision

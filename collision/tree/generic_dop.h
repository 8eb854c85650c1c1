#pragma once

/// The generic DOP of paper §2.1: one polytope in which every half-space supports a face and every vertex lies on
/// exactly three planes. For any direction, its extremal vertex names the three half-spaces that bound this direction
/// best in *every* DOP.

#include <array>
#include <vector>

#include <Eigen/Core>

namespace glissade::collision {

/// A vertex of the generic DOP. Its mirror image through the origin is a vertex, too, on the opposite planes.
struct GenericVertex {
  Eigen::Vector3d position;
  std::array<int, 3> half_spaces;  ///< the planes it lies on
  /// Maps a direction c to the weights w with Σ w_l b_l = c, where b_l are the unit directions of `half_spaces`.
  Eigen::Matrix3d weights_of_direction;
};

/// One of each pair of mirrored vertices, so k − 2 of 2k − 4. Computed once per k and process. k as for
/// `dop_directions`. Thread-safe.
const std::vector<GenericVertex>& generic_dop_vertices(int k);

}  // namespace glissade::collision

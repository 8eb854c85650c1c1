#pragma once

/// The test of thin slabs. Boxes of fixed directions converge to a smooth surface only linearly as they get smaller; a
/// slab along the surface's own normal converges quadratically. That determines the cost of close parallel surfaces.
///
/// All points of a child lie within a distance `half_width` of a plane and within `radius` of a point c. Along the
/// normal of the other child they extend by at most half_width · |cos θ| + radius · sin θ, where θ is the angle between
/// the normals. The slab of either child may separate the pair.

#include <array>

#include "kernels/query_frame.h"

namespace glissade::collision {

/// Maps grid steps of N to grid steps of M, in single precision.
struct ThinSlabFrame {
  explicit ThinSlabFrame(const QueryFrame& frame);

  std::array<std::array<float, 3>, 3> R_MN;
  std::array<float, 3> p_MN;  ///< in grid steps of M
  float ratio;                ///< one grid step of N in grid steps of M
  float padding;              ///< bound on rounding errors, in grid steps of M
};

}  // namespace glissade::collision

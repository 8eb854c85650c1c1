#pragma once

/// The test of thin slabs: boxes of fixed directions close in on a smooth surface only linearly as they get smaller, a
/// slab along the surface's own normal does so quadratically. That decides what close parallel surfaces cost.
///
/// The points of a child lie within a distance `half_width` of a plane and within `radius` of a point c. Along the
/// normal of the other child they reach at most half_width · |cos| + radius · sin of the angle between the normals. The
/// slab of either child may separate the pair.

#include <array>

#include "kernels/query_frame.h"

namespace glissade::collision {

/// From grid steps of N to those of M, in single precision.
struct ThinSlabFrame {
  explicit ThinSlabFrame(const QueryFrame& frame);

  std::array<std::array<float, 3>, 3> R_MN;
  std::array<float, 3> p_MN;  ///< in grid steps of M
  float ratio;                ///< grid steps of M in one of N
  float padding;              ///< grid steps of M; what rounding may have moved
};

}  // namespace glissade::collision

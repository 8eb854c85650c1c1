#pragma once

/// The test of thin slabs: boxes of fixed directions close in on a smooth surface only linearly as they get smaller, a
/// slab along the surface's own normal does so quadratically. That decides what close parallel surfaces cost.
///
/// The points of a child lie within a distance `half_width` of a plane and within `radius` of a point c. Along the
/// normal of the other child they reach at most half_width · |cos| + radius · sin of the angle between the normals. The
/// slab of either child may separate the pair.

#include <array>

#include "query_frame.h"

namespace glissade::collision {

/// From grid steps of Q to those of P, in single precision.
struct ThinSlabFrame {
  explicit ThinSlabFrame(const QueryFrame& frame);

  std::array<std::array<float, 3>, 3> R_PQ;
  std::array<float, 3> p_PQ;  ///< in grid steps of P
  float ratio;                ///< grid steps of P in one of Q
  float padding;              ///< grid steps of P; what rounding may have moved
};

}  // namespace glissade::collision

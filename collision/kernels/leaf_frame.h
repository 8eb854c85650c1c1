#pragma once

/// The transform of leaves of N into the frame of M, in single precision, with bounds of its errors.

#include <array>

#include "kernels/query_frame.h"

namespace glissade::collision {

/// Maps coordinates in radii of N to coordinates in radii of M, in single precision.
struct LeafFrame {
  explicit LeafFrame(const QueryFrame& frame);

  std::array<std::array<float, 3>, 3> matrix;  ///< rotation times ratio
  std::array<float, 3> p_MN;
  float uncertainty;         ///< bound on the error of a gap between two triangles along a unit vector, in radii of M
  float corner_uncertainty;  ///< bound on the sum of the errors of a coordinate of a corner of M and of one of N
  float edge_uncertainty_M;  ///< bound on the error of a coordinate of the difference of two corners of M
};

}  // namespace glissade::collision

#pragma once

/// The frame in which leaves are compared, in single precision with bounds of its errors.

#include <array>

#include "kernels/query_frame.h"

namespace glissade::collision {

/// From radii of N to those of M, in single precision.
struct LeafFrame {
  explicit LeafFrame(const QueryFrame& frame);

  std::array<std::array<float, 3>, 3> matrix;  ///< rotation times ratio
  std::array<float, 3> p_MN;
  float uncertainty;         ///< bound on the error of a gap between two triangles along a unit vector, in radii of M
  float corner_uncertainty;  ///< bounds the error of a coordinate of a corner of M and one of N together
  float edge_uncertainty_M;  ///< and that of the difference of two corners of M
};

}  // namespace glissade::collision

#include "kernels/vertex_alignment.h"

#include <cmath>

namespace glissade::collision {

VertexAlignment::VertexAlignment(const DopDirections& directions, const QueryFrame& frame)
    : direction{}, above{}, below{}, slabs(directions.slabs) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(slabs); ++i) {
    const Eigen::Vector3d direction_N = frame.ratio * (frame.R_MN.transpose() * directions.unit[i]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      direction[i][axis] = static_cast<float>(direction_N[static_cast<Eigen::Index>(axis)]);

    // Single precision rounds the direction, the vertex, their products and the sum of these: six roundings by 2^-24 of
    // values no larger than a corner of the grid. It also rounds this offset and its sum with the others. The padding
    // is twice that, because errors of double precision are far smaller.
    const double center = kGridRadius * directions.unit[i].dot(frame.p_MN);
    const double largest = 2.0 * kGridRadius * frame.ratio + std::abs(center);
    const double padding = std::ldexp(largest, -20) + kGridRadius * frame.uncertainty;
    above[i] = static_cast<float>(center + padding);
    below[i] = static_cast<float>(-center + padding);
  }
}

}  // namespace glissade::collision

#pragma once

/// The vector code of separating planes: how far many pairs of triangles are apart, each along a direction of its own.
/// Single precision, with slack for its rounding.

#include <array>
#include <cstddef>
#include <span>

namespace glissade::haptics {

inline constexpr std::size_t kPlanesAtOnce = 16;

/// A number for each of sixteen pairs.
using NumbersOfPlanes = std::array<float, kPlanesAtOnce>;

/// Sixteen pairs of triangles of two bodies. A direction is fixed to one of them. No point of this body's triangle is
/// higher than `top` along n, which points to the other triangle.
struct alignas(64) PlaneBlock {
  std::array<NumbersOfPlanes, 3> n;                 ///< [axis], in the axes of the body to which it is fixed; units
  NumbersOfPlanes top;                              ///< metres
  NumbersOfPlanes turns_with_part;                  ///< 1 where n is fixed to the part, 0 where to the obstacle
  std::array<std::array<NumbersOfPlanes, 3>, 3> x;  ///< the triangle of the other body, [corner][axis], metres
};

/// Maps coordinates x in one body's frame to those in the other's: A x + t.
struct PlaneMap {
  std::array<std::array<float, 3>, 3> A;  ///< [row][column]
  std::array<float, 3> t;                 ///< metres
};

/// Where two bodies are: the part in the frame of the obstacle, and the other way round.
struct PlaneMaps {
  PlaneMap of_part;
  PlaneMap of_obstacle;
  float slack;  ///< metres: bound of the rounding of a gap
};

/// Sets `gaps`, kPlanesAtOnce for each block, to the least height of the corners x over `top`, less the slack; metres.
/// Thread-safe.
void find_plane_gaps(std::span<const PlaneBlock> blocks, const PlaneMaps& maps, float* gaps);

}  // namespace glissade::haptics

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

/// Sixteen pairs of triangles of two bodies. No point of the obstacle's triangle is higher than `top` along n.
struct alignas(64) PlaneBlock {
  std::array<NumbersOfPlanes, 3> n;                 ///< [axis], in the obstacle's axes; unit vectors
  NumbersOfPlanes top;                              ///< metres
  std::array<std::array<NumbersOfPlanes, 3>, 3> x;  ///< the part's triangle, [corner][axis], metres
};

/// Maps the coordinates x of the part's corners to those of the obstacle's frame: A x + t.
struct PlaneMap {
  std::array<std::array<float, 3>, 3> A;  ///< [row][column]
  std::array<float, 3> t;                 ///< metres
};

/// Sets `gaps`, kPlanesAtOnce for each block, to the least height of the part's corners over `top`, less `slack`;
/// metres. Thread-safe.
void find_plane_gaps(std::span<const PlaneBlock> blocks, const PlaneMap& map, float slack, float* gaps);

}  // namespace glissade::haptics

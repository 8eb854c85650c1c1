#pragma once

/// The vector code of separating planes. It computes how far many pairs of triangles are apart, each along a direction
/// of its own, and finds the pairs whose gaps are too small. It uses single precision; slack covers the rounding.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace glissade::contact {

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

/// Some pairs of a block: a bit for each, the first one lowest.
using PairsOfBlock = std::uint16_t;

/// What gaps must be, metres.
struct NeededGaps {
  float fixed;    ///< along directions that are fixed to the obstacle
  float turning;  ///< along those that turn with the part
  float far;      ///< pairs with greater gaps at the beginning need nothing at the end
};

// Of the following functions, those for many blocks take kPlanesAtOnce gaps of each, one block after the other. All are
// thread-safe.

/// Sets the gaps (metres) to the least heights of the corners x over `top`, less the slack.
void find_plane_gaps(std::span<const PlaneBlock> blocks, const PlaneMaps& maps, float* gaps);

/// Raises each gap to what else is known of it, which is its `known` less `clock` (metres; the clock is finite). Sets
/// `least` to the least gap of each block.
void raise_gaps(std::span<const float> known, float clock, float* gaps, float* least);

/// The pairs of a block whose gaps are at most `limit`.
PairsOfBlock find_pairs_within(float limit, const float* gaps);

/// The pairs of a block whose gap is less than needed at either end of a path, and not far at the beginning.
PairsOfBlock find_unproved(const PlaneBlock& block, const NeededGaps& needed, const float* gaps_at_begin,
                           const float* gaps_at_end);

}  // namespace glissade::contact

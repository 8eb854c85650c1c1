#pragma once

/// Pairs of a child of one node and a child of another, or of triangles of two leaves: 16 pairs, numbered 4 · child_M +
/// child_N.

#include <array>
#include <cstdint>

#include "tree/dop_node.h"

namespace glissade::collision {

/// One bit for each pair.
using PairMask = std::uint32_t;
inline constexpr PairMask kAllPairs = 0xffff;

/// For each pair, the least overlap of the two boxes over all slabs, in grid steps of M. If it is negative, the boxes
/// are certainly apart by at least its absolute value.
struct alignas(32) PairOverlaps {
  std::array<std::int16_t, kWidth * kWidth> overlap;
};

}  // namespace glissade::collision

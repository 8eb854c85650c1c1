#pragma once

/// Pairs of the four children of one node, or of the four triangles of one leaf, with those of another, numbered
/// 4 · child_M + child_N.

#include <array>
#include <cstdint>

#include "tree/dop_node.h"

namespace glissade::collision {

/// One bit for each pair.
using PairMask = std::uint32_t;
inline constexpr PairMask kAllPairs = 0xffff;

/// How far the boxes of each pair overlap along the slab where they do least, in grid steps of M; when negative, the
/// boxes are certainly at least so far apart.
struct alignas(32) PairOverlaps {
  std::array<std::int16_t, kWidth * kWidth> overlap;
};

}  // namespace glissade::collision

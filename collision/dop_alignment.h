#pragma once

/// Realignment (paper §2.1, eq. 1): encloses the tumbled nodes of one tree by DOPs aligned to the frame of another,
/// each new plane offset being a combination of three old ones. Which three, and the weights, are found once per query;
/// a node then costs O(k).

#include <array>
#include <cstdint>

#include <glissade/collision/dop.h>
#include <glissade/collision/dop_node.h>

#include "query_frame.h"

namespace glissade::collision {

/// Rows of a node, rounded up to whole lines.
inline constexpr int kMostRows = 4 * slab_lines(kMostSlabs);

/// Three weights each and an offset for every half-space, in the layout of the vector code (`node_kernels.h`).
///
/// It cannot make a DOP too small: for weights w ≥ 0 with Σ w_l b_l = c, the sum Σ w_l s_l bounds c·x over every DOP
/// whatever the half-spaces l (linear-programming duality), so a poor choice of l costs tightness only. What rounding
/// takes away is added back as a constant to the offset: see docs/collision.md.
struct alignas(64) DopAlignment {
  // Lanes of one row of an aligned node, four children each: what faces `above`, what faces `below` of a SlabRow.
  using Lanes = std::array<std::int16_t, 8 * kMostRows>;

  std::array<Lanes, 3> weight;  ///< in 2^-15
  Lanes offset;                 ///< in grid steps of the base

  /// For each row and term, the half-space of the node that bounds the direction of the base's half-space i < slabs.
  std::array<std::array<std::uint8_t, kMostRows>, 3> half_space;
  /// The same as indices of quarter lines (FourValues), two a row, for permutations.
  std::array<std::array<std::uint8_t, 2 * kMostRows>, 3> source;

  int slabs;

  /// For nodes of a tree with these directions seen in `frame`.
  void align(const DopDirections& directions, int k, const QueryFrame& frame);
};

}  // namespace glissade::collision

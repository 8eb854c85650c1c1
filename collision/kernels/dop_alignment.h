#pragma once

/// Realignment (paper §2.1, eq. 1): encloses the rotated nodes of one tree in DOPs aligned to the frame of the other.
/// Each new plane offset is a combination of three old ones. The choice of the three, and their weights, are computed
/// once per query; a node then costs O(k) (`node_kernels.h`).

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/quarter_line.h"
#include "kernels/query_frame.h"
#include "tree/dop.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// Rows (slabs) of a node, rounded up to whole cache lines.
inline constexpr int kMostRows = 4 * slab_lines(kMostSlabs);

/// Three weights and an offset for each half-space, in the layout of the vector code.
///
/// A realigned DOP is never too small. For weights w ≥ 0 with Σ w_l b_l = c, the sum Σ w_l s_l bounds c·x over every
/// DOP for any choice of the half-spaces l (linear-programming duality), so a poor choice costs tightness only. A
/// constant in the offset compensates for rounding: see docs/collision.md.
struct alignas(64) DopAlignment {
  // Eight lanes a row: for each of four children the bound that faces `above` of M, then for each the bound that faces
  // `below`.
  using Lanes = std::array<std::int16_t, 8 * kMostRows>;

  std::array<Lanes, 3> weight;                                   ///< of each term, in 2^-15
  Lanes offset;                                                  ///< in grid steps of the base
  std::array<std::array<QuarterLine, 2 * kMostRows>, 3> source;  ///< the quarter line that each term is read from
  int slabs;
};

/// Computes the alignment for trees with k directions at the relative pose `frame`. Cost O(k²), once per query.
void align(int k, const QueryFrame& frame, DopAlignment& alignment);

}  // namespace glissade::collision

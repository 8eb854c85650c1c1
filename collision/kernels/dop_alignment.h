#pragma once

/// Realignment (paper §2.1, eq. 1): encloses the tumbled nodes of one tree by DOPs aligned to the frame of another,
/// each new plane offset being a combination of three old ones. Which three, and the weights, are found once per query;
/// a node then costs O(k) (`node_kernels.h`).

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/quarter_line.h"
#include "kernels/query_frame.h"
#include "tree/dop.h"
#include "tree/dop_node.h"

namespace glissade::collision {

/// Rows of a node, rounded up to whole lines.
inline constexpr int kMostRows = 4 * slab_lines(kMostSlabs);

/// Three weights each and an offset for every half-space, in the layout of the vector code.
///
/// It cannot make a DOP too small: for weights w ≥ 0 with Σ w_l b_l = c, the sum Σ w_l s_l bounds c·x over every DOP
/// whatever the half-spaces l (linear-programming duality), so a poor choice of l costs tightness only. What rounding
/// takes away is added back as a constant to the offset: see docs/collision.md.
struct alignas(64) DopAlignment {
  // Eight lanes a row: what faces `above` of four children, what faces their `below`.
  using Lanes = std::array<std::int16_t, 8 * kMostRows>;

  std::array<Lanes, 3> weight;                                   ///< of each term, in 2^-15
  Lanes offset;                                                  ///< in grid steps of the base
  std::array<std::array<QuarterLine, 2 * kMostRows>, 3> source;  ///< where each term is read
  int slabs;
};

/// Finds the alignment for nodes of trees with k directions that are seen in `frame`. O(k²), once per query.
void align(int k, const QueryFrame& frame, DopAlignment& alignment);

}  // namespace glissade::collision

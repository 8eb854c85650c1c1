#pragma once

/// Walks over blocks of pairs with planes, of which only some are near.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "certificate/plane_kernel.h"

namespace glissade::contact {

/// So many blocks of planes fit into the fastest cache.
inline constexpr std::ptrdiff_t kBlocksInCache = 16;

/// Calls `visit` with the first and the end of each run of blocks whose `gaps`, one for each, are near; a run is short
/// enough to be visited twice.
template <typename Gap, typename IsNear, typename Visit>
void visit_runs_of_blocks(const std::vector<Gap>& gaps, const IsNear& is_near, const Visit& visit) {
  auto first = std::find_if(gaps.begin(), gaps.end(), is_near);
  while (first != gaps.end()) {
    const auto end = std::find_if_not(first, first + std::min(kBlocksInCache, gaps.end() - first), is_near);
    visit(static_cast<std::size_t>(first - gaps.begin()), static_cast<std::size_t>(end - gaps.begin()));
    first = std::find_if(end, gaps.end(), is_near);
  }
}

/// Calls `visit` with the slots of some pairs of a block, in ascending order.
template <typename Visit>
void for_each_pair(std::size_t block, PairsOfBlock pairs, const Visit& visit) {
  for (; pairs != 0; pairs &= static_cast<PairsOfBlock>(pairs - 1U))
    visit(kPlanesAtOnce * block + static_cast<std::size_t>(std::countr_zero(pairs)));
}

}  // namespace glissade::contact

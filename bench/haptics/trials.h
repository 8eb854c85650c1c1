#pragma once

/// Counts what becomes of many trials, each of a seed of its own, on all processors. For counts only: times taken side
/// by side would be those of trials that wait for each other.

#include <atomic>
#include <cstdint>

#include <tbb/parallel_for.h>

namespace glissade::bench {

/// How many of the trials 1 to `trials` `succeeds` is true of. It is called by several threads at once.
template <typename Succeeds>
int count_trials(int trials, const Succeeds& succeeds) {
  std::atomic<int> count = 0;
  tbb::parallel_for(1, trials + 1, [&](int trial) { count += succeeds(static_cast<std::uint64_t>(trial)) ? 1 : 0; });
  return count;
}

}  // namespace glissade::bench

#pragma once

/// Counts successful trials, each with a seed of its own, on all processors. For counts only: the times of trials that
/// run side by side would include their waiting for each other.

#include <atomic>
#include <cstdint>

#include <tbb/parallel_for.h>

namespace glissade::bench {

/// The number of trials from 1 to `trials` for which `succeeds` returns true. Several threads call it at once.
template <typename Succeeds>
int count_trials(int trials, const Succeeds& succeeds) {
  std::atomic<int> count = 0;
  tbb::parallel_for(1, trials + 1, [&](int trial) { count += succeeds(static_cast<std::uint64_t>(trial)) ? 1 : 0; });
  return count;
}

}  // namespace glissade::bench

#pragma once

/// Trials, each with a seed of its own, that are counted.

#include <atomic>
#include <cstdint>
#include <string>

#include <tbb/parallel_for.h>

#include "benches.h"

namespace glissade::bench {

/// A benchmark with the counters `trials` and `counted`: for how many of the seeds from 1 to `trials` `happens` returns
/// true. Several threads call it at once, so the time of a trial includes waiting for others.
template <typename Happens>
void register_trials(const std::string& name, int trials, const std::string& counted, Happens happens) {
  register_single_run(name, [=](benchmark::State& state) {
    std::atomic<int> count = 0;
    for (auto _ : state)
      tbb::parallel_for(1, trials + 1, [&](int seed) { count += happens(static_cast<std::uint64_t>(seed)) ? 1 : 0; });
    state.counters["trials"] = trials;
    state.counters[counted] = count.load();
  })->UseRealTime();
}

}  // namespace glissade::bench

#pragma once

/// The benchmarks, by the names of the command line. Each adds its rows to the results.

#include "bench_options.h"
#include "interleaved_passes.h"
#include "results.h"

namespace glissade::bench {

/// Two copies of an object at Zachmann's poses (paper §2.1.2): for random orientations and axes of approach, distances
/// from 0 to where the bounding boxes come apart; the time is averaged over all. Figure 3 of the paper.
void run_zachmann(const BenchOptions& options, Results& results);

PassLimits pass_limits(const BenchOptions& options);

}  // namespace glissade::bench

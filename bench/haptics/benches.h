#pragma once

/// The benchmarks of sliding contact; each adds rows of the bench `sliding`.

#include <cstdint>
#include <string>
#include <vector>

#include "results.h"

namespace glissade::bench {

inline constexpr const char* kSliding = "sliding";

struct SlidingBenchOptions {
  bool quick = false;
  std::vector<std::string> scenes;  ///< names of `sliding_scene_names`; empty: all
};

/// Each scene by each method: case `SCENE`, the metrics of `SlidingAccount` and p50 and p99 of the times of the ticks.
void run_scenes(const SlidingBenchOptions& options, Results& results);

/// Sheets led through sheets: case `sheets`, how many `trials` there were, how many `crossed`.
void run_sheets(const SlidingBenchOptions& options, Results& results);

/// Pegs led to the bottom of their holes, off by 0.3 mm and 0.5°: case `pegs`, how many `trials`, how many `inserted`.
void run_pegs(const SlidingBenchOptions& options, Results& results);

/// Random programmes of 1 to 64 rows: cases `solver-ROWS`, time of a projection, active contacts, time for each of
/// them.
void run_solver(const SlidingBenchOptions& options, Results& results);

}  // namespace glissade::bench

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

/// Sheets led through sheets: case `open-sheets`, how many `trials` there were, how many `crossed`. Runs on all
/// processors.
void run_sheets(const SlidingBenchOptions& options, Results& results);

/// Pegs led to the bottom of their holes: cases `pegs-0.3mm-0.5deg` and `pegs-1mm-1.5deg`, by how much the ghost is off
/// in the end, and `pegs-1mm-1.5deg-anti-jam`; how many `trials`, how many `inserted`. Runs on all processors.
void run_pegs(const SlidingBenchOptions& options, Results& results);

/// A nut whose ghost turns on its bolt and does not move along it: case `nut-turns`, how many `turns`, the `pitch`, the
/// `advance_per_turn`, the `worst_deviation` from the helix over all ticks, the mean time of a tick.
void run_nut(const SlidingBenchOptions& options, Results& results);

/// Random programmes of 1 to 64 rows: cases `solver-ROWS`, time of a projection, active contacts, time for each of
/// them.
void run_solver(const SlidingBenchOptions& options, Results& results);

}  // namespace glissade::bench

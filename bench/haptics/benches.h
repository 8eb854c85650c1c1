#pragma once

/// The benchmarks of sliding contact. Each adds rows to the bench `sliding`.

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

/// Each scene with each method: case `SCENE`, the metrics of `SlidingAccount`, and p50 and p99 of the tick times.
void run_scenes(const SlidingBenchOptions& options, Results& results);

/// Sheets whose ghosts pass through sheets: case `open-sheets`, metrics `trials` and `crossed`. Runs on all processors.
void run_sheets(const SlidingBenchOptions& options, Results& results);

/// Pegs whose ghosts go to the bottom of their holes: cases `pegs-0.3mm-0.5deg` and `pegs-1mm-1.5deg`, named after the
/// final deviation of the ghost, and `pegs-1mm-1.5deg-spiral-search`; metrics `trials` and `inserted`. Runs on all
/// processors.
void run_pegs(const SlidingBenchOptions& options, Results& results);

/// A nut whose ghost turns on its bolt and does not move along it: case `nut-turns`, metrics `turns`, `pitch`,
/// `advance_per_turn`, `worst_deviation` from the helix over all ticks, and `tick_mean`, the mean time of a tick.
void run_nut(const SlidingBenchOptions& options, Results& results);

/// Random quadratic programmes of 1 to 64 rows: cases `solver-ROWS`, metrics `time` of a projection, `active` contacts,
/// and `time_per_active`.
void run_solver(const SlidingBenchOptions& options, Results& results);

}  // namespace glissade::bench

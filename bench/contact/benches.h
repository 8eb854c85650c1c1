#pragma once

/// The benches of sliding contact. Each function registers one of them, or a part of one. A run is a benchmark of one
/// iteration. Quantiles, such as the counter `p99_ms`, are those of `CallTimes`; `tick` is the mean time of a tick,
/// seconds.

#include "bench_program.h"
#include "register_run.h"

namespace glissade::bench {

/// `sliding/SCENE`: each scene with each method in real time. Counters of `SlidingAccount`, and times of the ticks in
/// which a contact pushes.
void register_scenes(const BenchOptions& options);

/// `sliding/open-sheets`: sheets whose ghosts pass through sheets. Counters `trials` and `crossed`. Uses all
/// processors.
void register_sheets(const BenchOptions& options);

/// `sliding/pegs-0.3mm-0.5deg` and `sliding/pegs-1mm-1.5deg`, pegs whose ghosts go to the bottom of their holes, named
/// after the final deviation of the ghost; and `sliding/pegs-1mm-1.5deg-spiral-search`. Counters `trials` and
/// `inserted`. Uses all processors.
void register_pegs(const BenchOptions& options);

/// `sliding/nut-turns`: a nut whose ghost turns on its bolt and does not move along it. Counters `turns`, `pitch_mm`,
/// `advance_per_turn_mm`, `worst_deviation_um` from the helix over all ticks, and `tick`.
void register_nut(const BenchOptions& options);

/// `sliding/solver-ROWS`: random quadratic programmes. Counters `active` contacts and `time_per_active`, seconds.
void register_solver(const BenchOptions& options);

/// `led/PART` and `led/PART+PART`: the user's meshes in real time, two copies of each and each pair: the ghost wanders
/// at 0.5 m/s through the obstacle. Counters `ticks`, `triangles` of both, the share `pushed` of ticks in which a
/// contact pushes, `colliding_poses`, and times of these ticks. Nothing without meshes. A run throws
/// std::invalid_argument, naming the pair, where the start collides or the two come nowhere near each other.
void register_led(const BenchOptions& options);

}  // namespace glissade::bench

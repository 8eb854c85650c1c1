#pragma once

/// The benches of the haptic loop and of sliding contact. Each function registers one of them, or a part of one. A run
/// is a benchmark of one iteration. Quantiles, such as the counter `p99_ms`, are those of `CallTimes`; `tick` is the
/// mean time of a tick, seconds.

#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "bench_program.h"

namespace glissade::bench {

/// A benchmark of one iteration, which may take turns with others.
template <typename Run>
benchmark::internal::Benchmark* register_run(const std::string& name, Run run) {
  return benchmark::RegisterBenchmark(name.c_str(), std::move(run))->Iterations(1)->Unit(benchmark::kMillisecond);
}

/// One whose outcome is always the same, or takes long: it runs once, however often others are repeated.
template <typename Run>
benchmark::internal::Benchmark* register_single_run(const std::string& name, Run run) {
  return register_run(name, std::move(run))->Repetitions(1);
}

/// `tick/rows-ROWS` and `tick/rows-12-two-hands`: a tick of the haptic kernel.
void register_tick(const BenchOptions& options);

/// `tick/SCENE-AGEms`: the force between two answers of the simulation, with sets of different ages. Subjects
/// `glissade`, `last-force` (the force of the set is held) and `penalty` (a spring at each contact of the set);
/// counters `error_max_percent` and `error_rms_percent` against the simulation's answer to the ghost of that tick, of
/// the peak `peak_N` of the force. On `fast-plane` also `sideways_percent`, the greatest force along it over that
/// across it.
void register_old_sets(const BenchOptions& options);

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

/// `passivity`: the stability of the coupling, without a clock. `DEVICE-DELAYms`: counters `stiffness_N_per_m` (by
/// `passive_stiffness`), `simulated_N_per_m` (from where an oscillation grows) and their ratio. `random`: `settings`,
/// `least_energy_J` of the observer, `most_given_J` to a hand. `wall-DELAYms`, by the delay of the round trip:
/// `stiffness_N_per_m`, `force_N`, `overshoot_percent`, `settled_after_ms` and `unrest_N` of a hand that presses on a
/// wall.
void register_passivity(const BenchOptions& options);

/// `ages/SCENE`: the simulation in real time with `real_time_rules`, subjects `without-budget` and `with-budget` of
/// work (`SlidingRules::work_budget`). Quantiles `age_` of the age of the newest answer, each millisecond, and `call_`
/// of the calls; counters `lag_mean_mm` of the visible part behind the ghost, and `ended_early_percent` of the calls.
void register_ages(const BenchOptions& options);

/// `led/PART` and `led/PART+PART`: the user's meshes in real time, two copies of each and each pair: the ghost wanders
/// at 0.5 m/s through the obstacle. Counters `ticks`, `triangles` of both, the share `pushed` of ticks in which a
/// contact pushes, `colliding_poses`, and times of these ticks. Nothing without meshes. A run throws
/// std::invalid_argument, naming the pair, where the start collides or the two come nowhere near each other.
void register_led(const BenchOptions& options);

/// `replay/car-door`: a recorded offline run is repeated. Counters `tick` and `wrong`, 1 unless all bits are the same.
void register_replay(const BenchOptions& options);

}  // namespace glissade::bench

#pragma once

/// The benches of the haptic loop. Each function registers one of them, or a part of one. A run is a benchmark of one
/// iteration. Quantiles, such as the counter `p99_ms`, are those of `CallTimes`; `tick` is the mean time of a tick,
/// seconds.

#include "bench_program.h"
#include "register_run.h"

namespace glissade::bench {

/// `tick/rows-ROWS` and `tick/rows-12-two-hands`: a tick of the haptic kernel.
void register_tick(const BenchOptions& options);

/// `tick/SCENE-AGEms`: the force between two answers of the simulation, with sets of different ages. Subjects
/// `glissade`, `last-force` (the force of the set is held) and `penalty` (a spring at each contact of the set);
/// counters `error_max_percent` and `error_rms_percent` against the simulation's answer to the ghost of that tick, of
/// the peak `peak_N` of the force. On `fast-plane` also `sideways_percent`, the greatest force along it over that
/// across it.
void register_old_sets(const BenchOptions& options);

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

/// `replay/car-door`: a recorded offline run is repeated. Counters `tick` and `wrong`, 1 unless all bits are the same.
void register_replay(const BenchOptions& options);

}  // namespace glissade::bench

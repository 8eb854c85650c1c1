#pragma once

/// The benchmarks of sliding contact. Each adds rows to the bench `sliding`, `run_tick` to the bench `tick`,
/// `run_passivity` to the bench `passivity`, `run_ages` to the bench `ages`, `run_clasp` to the bench `clasp`,
/// `run_led` to the bench `led`.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "results.h"

namespace glissade::bench {

inline constexpr const char* kSliding = "sliding";
inline constexpr const char* kTick = "tick";
inline constexpr const char* kPassivity = "passivity";
inline constexpr const char* kAges = "ages";
inline constexpr const char* kClasp = "clasp";
inline constexpr const char* kLed = "led";

struct SlidingBenchOptions {
  bool quick = false;
  std::vector<std::string> scenes;                ///< names of `sliding_scene_names`; empty: all
  std::vector<std::string> scene_files;           ///< more scenes for `run_tick`
  std::string meshes;                             ///< folder of more meshes for `run_ages`; empty: none
  std::vector<std::filesystem::path> led_meshes;  ///< meshes and folders of them for `run_led`
  std::filesystem::path led_pairs;                ///< a file for `user_pairs`, of these meshes; or empty
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

/// The force between two answers of the simulation, with sets of different ages: cases `SCENE-AGEms`, subjects
/// `glissade`, `last-force` (the force of the set is held) and `penalty` (a spring at each contact of the set), metrics
/// `error_max` and `error_rms` against the simulation's answer to the ghost of that tick, in percent of the peak of the
/// force; `sideways` on the plane. Cases `cost-ROWS` and `cost-envelope`: metric `time` of a tick, and of the envelope.
void run_tick(const SlidingBenchOptions& options, Results& results);

/// The stability of the coupling, without a clock. Cases `DEVICE-DELAYms`: metric `stiffness` of the subjects
/// `glissade` (`passive_stiffness`) and `simulation` (from where an oscillation grows), `ratio_to_simulation`. Case
/// `random`: `settings`, `least_energy` of the observer, `most_given` to a hand. Cases `wall-DELAYms`, by the delay of
/// the round trip: `stiffness`, `force`, `overshoot`, `settled_after` and `unrest` of a hand that presses on a wall.
void run_passivity(const SlidingBenchOptions& options, Results& results);

/// The simulation in real time with `real_time_rules`: case `SCENE`, subjects `without-budget` and `with-budget` of
/// work
/// (`SlidingRules::work_budget`), metrics `age_p50`, `age_p99` and `age_max` of the newest answer, each millisecond,
/// the same of the durations of calls, `lag_mean` of the visible part behind the ghost, and `ended_early`, the share of
/// calls.
void run_ages(const SlidingBenchOptions& options, Results& results);

/// The clasp of a hand round a ball of 16,000 triangles (`grasping::Clasp`), a millisecond a call: cases `free` and
/// `closing` (fingers that close, before and after the first contact), `held`, `wild` and `from-scratch`; and
/// `two-hands-100-objects`, whole calls of `grasping::GraspSimulation`, with the share `both_hold`. Metrics `call_p50`,
/// `call_p99` and `call_max`: time of the thread on a processor.
void run_clasp(const SlidingBenchOptions& options, Results& results);

/// The user's meshes in real time, two copies of each and each pair of `led_pairs`: the ghost wanders at 0.5 m/s
/// through the obstacle. Case `PART` or `PART/PART`, metrics `ticks`, `triangles` of both, the share `pushed` of ticks
/// in which a contact pushes, `colliding_poses`, and `tick_mean`, `tick_p50`, `tick_p99` and `tick_max` of these ticks.
/// Throws std::invalid_argument, naming the pair, where the start collides or the two come nowhere near each other.
void run_led(const SlidingBenchOptions& options, Results& results);

}  // namespace glissade::bench

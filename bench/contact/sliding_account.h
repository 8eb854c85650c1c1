#pragma once

/// Quality and cost of a sliding method in a scene: the measurements of the benchmarks of sliding contact. They use a
/// method through `reference::SlidingSimulation` only.

#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>
#include <glissade/reference/sliding_method.h>

#include "call_times.h"
#include "sliding_subject.h"

namespace glissade::bench {

/// A run as in real time: ticks begin a millisecond apart, and a thread of its own searches ahead of need. The times
/// are of this run alone, all else is the same in each.
struct PacedRun {
  CallTimes times{};  ///< of the ticks in which a contact pushes
  contact::CouplingStiffness stiffness{};
  double margin = 0.0;
  std::vector<Eigen::Isometry3d> X_WV{};        ///< visible pose at the start and after each tick
  std::vector<geometry::Displacement> error{};  ///< likewise, from the visible pose to the ghost
  double queries_per_tick = 0.0;

  /// Sets `tick` and the quantiles. For manual time.
  void report_times(benchmark::State& state) const;
};
PacedRun run_paced(const SlidingSubject& subject, const test_support::SlidingScene& scene, int ticks);

/// The qualities of a run. A stretch is the length of a spring of the translational stiffness k_t that stores as much
/// energy as both springs of the coupling.
struct SlidingAccount {
  int ticks = 0;
  double final_stretch_m = 0.0;  ///< at the end; without collisions, smaller means nearer to the goal
  double mean_stretch_m = 0.0;   ///< over all ticks
  /// Ticks in which the ghost was more than 0.1 mm ahead, the part moved by less than 1 µm, and could have moved by
  /// `JamCheck`.
  int jammed_ticks = 0;
  /// Greatest change of the force on the hand from one tick to the next, newtons. Torque counts divided by the radius.
  double force_jump_N = 0.0;
  /// The same divided by the bound of a tick, k_t (0.2 mm + motion of the ghost): at most 1.
  double force_jump_of_bound = 0.0;
  int colliding_poses = 0;  ///< visible poses that collide, by `reference::GridCheck`
  double queries_per_tick = 0.0;

  /// Sets counters of these names, with their units.
  void report(benchmark::State& state) const;
};
SlidingAccount account_of(const PacedRun& run, const test_support::SlidingScene& scene);

/// Poses of the part that collide, by `reference::GridCheck`. Runs on all processors.
int count_collisions(const test_support::SlidingScene& scene, const std::vector<Eigen::Isometry3d>& poses_WV);

}  // namespace glissade::bench

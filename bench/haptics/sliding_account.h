#pragma once

/// How well a method leads a part through a scene, and what it costs. The measuring core of the benchmarks of sliding
/// contact: it knows a method as `haptics::SlidingSimulation` only.

#include <cstdint>
#include <vector>

#include "sliding_subject.h"

namespace glissade::bench {

/// What became of a run. Lengths of the spring are those of a spring of the translational stiffness k_t that would hold
/// as much energy as the coupling's springs do together.
struct SlidingAccount {
  int ticks = 0;
  double final_stretch_m = 0.0;  ///< of the spring, at the end: among methods that collide nowhere, less is nearer
  double mean_stretch_m = 0.0;   ///< over all ticks
  /// Ticks in which the ghost was over 0.1 mm ahead, the part moved by less than 1 µm, and `JamCheck` says it could
  /// have.
  int jammed_ticks = 0;
  /// Greatest change of the force on the hand from one tick to the next, newtons; torque counts by the part's radius.
  double force_jump_N = 0.0;
  /// The same by what a tick may do, k_t (0.2 mm + how far the ghost moved): not over 1.
  double force_jump_of_bound = 0.0;
  int colliding_poses = 0;  ///< visible poses that collide, by `reference::GridCheck`
  double queries_per_tick = 0.0;
  std::vector<char> pushes;  ///< of each tick: whether a contact pushes
};

/// Leads the part through the first `ticks` of the scene.
SlidingAccount account_of(const SlidingSubject& subject, const test_support::SlidingScene& scene, int ticks);

/// Microseconds of each tick of a run as in real time: ticks begin a millisecond apart, and what can be looked for
/// ahead of need is looked for in a thread of its own.
std::vector<double> tick_times(const SlidingSubject& subject, const test_support::SlidingScene& scene, int ticks);

/// Sorts the values. p in [0, 1].
double quantile(std::vector<double> values, double p);

}  // namespace glissade::bench

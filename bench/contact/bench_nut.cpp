// See `register_nut` in benches.h.

#include <algorithm>
#include <cmath>

#include "benches.h"
#include "seconds_each.h"
#include "sliding_subject.h"

namespace glissade::bench {
namespace {

constexpr int kTicksPerTurn = 1000;

void turn_nut(benchmark::State& state, const SlidingSubject& subject, const test_support::SlidingScene& scene,
              int ticks) {
  const SlidingRun run = start(subject, scene);
  double worst_m = 0.0;
  double advance_m = 0.0;
  for (auto _ : state) {
    for (int tick = 1; tick <= ticks; ++tick) {
      run.sliding->advance(scene.ghost(tick));
      advance_m = test_support::nut_advance(scene, run.sliding->result().X_WV);
      const double helix_m = test_support::nut_pitch() * tick / kTicksPerTurn;
      worst_m = std::max(worst_m, std::abs(advance_m - helix_m));
    }
  }
  const double turns = static_cast<double>(ticks) / kTicksPerTurn;
  state.counters["tick"] = seconds_each(ticks);
  state.counters["turns"] = turns;
  state.counters["pitch_mm"] = 1e3 * test_support::nut_pitch();
  state.counters["advance_per_turn_mm"] = 1e3 * advance_m / turns;
  state.counters["worst_deviation_um"] = 1e6 * worst_m;
}

}  // namespace

void register_nut(const BenchOptions& options) {
  const auto scene = lazy([] { return test_support::nut_scene(); });
  for (const SlidingSubject& subject : kSlidingSubjects) {
    register_single_run(
        "sliding/nut-turns/" + subject.name,
        [=, ticks = options.quick ? 200 : 3000](benchmark::State& state) { turn_nut(state, subject, **scene, ticks); });
  }
}

}  // namespace glissade::bench

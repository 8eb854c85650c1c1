// See `run_nut` in benches.h.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "benches.h"
#include "sliding_subject.h"

namespace glissade::bench {
namespace {

constexpr int kTicksPerTurn = 1000;

void turn(const SlidingSubject& subject, const test_support::SlidingScene& scene, int turns, Results& results) {
  const SlidingRun run = start(subject, scene);
  double worst_m = 0.0;
  double advance_m = 0.0;
  const auto started = std::chrono::steady_clock::now();
  for (int tick = 1; tick <= turns * kTicksPerTurn; ++tick) {
    run.sliding->advance(scene.ghost(tick));
    advance_m = test_support::nut_advance(scene, run.sliding->result().X_WV);
    const double helix_m = test_support::nut_pitch() * tick / kTicksPerTurn;
    worst_m = std::max(worst_m, std::abs(advance_m - helix_m));
    if (tick % kTicksPerTurn != 0) continue;
    std::fprintf(stderr, "sliding nut-turns %s turn %d of %d, %.1f um from the helix at worst\n", subject.name.c_str(),
                 tick / kTicksPerTurn, turns, 1e6 * worst_m);
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - started;
  const auto row = [&](const char* metric, double value, const char* unit) {
    results.add({kSliding, "nut-turns", subject.name, metric, value, unit});
  };
  row("turns", turns, "1");
  row("pitch", 1e3 * test_support::nut_pitch(), "mm");
  row("advance_per_turn", 1e3 * advance_m / turns, "mm");
  row("worst_deviation", 1e6 * worst_m, "um");
  row("tick_mean", took.count() / (turns * kTicksPerTurn), "ms");
}

}  // namespace

void run_nut(const SlidingBenchOptions& options, Results& results) {
  const test_support::SlidingScene scene = test_support::nut_scene();
  for (const SlidingSubject& subject : kSlidingSubjects)
    turn(subject, scene, options.quick ? 1 : scene.ticks / kTicksPerTurn, results);
}

}  // namespace glissade::bench

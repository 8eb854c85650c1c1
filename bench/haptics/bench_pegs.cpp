// See `run_pegs` in benches.h.

#include <cstdio>
#include <numbers>

#include "benches.h"
#include "sliding_subject.h"

namespace glissade::bench {
namespace {

constexpr double kInserted_m = 7e-3;  // the ghost goes 8 mm deep

bool is_inserted(const SlidingSubject& subject, const test_support::SlidingScene& scene) {
  const SlidingRun run = start(subject, scene);
  for (int tick = 1; tick <= scene.ticks; ++tick)
    run.sliding->advance(scene.ghost(tick));
  return run.sliding->result().X_WV.translation().z() < -kInserted_m;
}

}  // namespace

void run_pegs(const SlidingBenchOptions& options, Results& results) {
  const int trials = options.quick ? 3 : 50;
  for (const SlidingSubject& subject : kSlidingSubjects) {
    std::fprintf(stderr, "sliding pegs %s\n", subject.name.c_str());
    int inserted = 0;
    for (int trial = 1; trial <= trials; ++trial) {
      const test_support::PegTrial peg{0.3e-3, 0.5 * std::numbers::pi / 180.0, static_cast<std::uint64_t>(trial)};
      inserted += is_inserted(subject, test_support::peg_scene(peg)) ? 1 : 0;
    }
    results.add({kSliding, "pegs", subject.name, "trials", static_cast<double>(trials), "1"});
    results.add({kSliding, "pegs", subject.name, "inserted", static_cast<double>(inserted), "1"});
  }
}

}  // namespace glissade::bench

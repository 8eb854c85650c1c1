// See `run_sheets` in benches.h.

#include <cstdio>

#include <glissade/haptics/sliding.h>

#include "benches.h"
#include "sliding_subject.h"
#include "trials.h"

namespace glissade::bench {
namespace {

bool crosses(const SlidingSubject& subject, std::uint64_t seed) {
  const test_support::SlidingScene scene = test_support::sheets_scene(seed);
  const SlidingRun run = start(subject, scene);
  for (int tick = 1; tick <= scene.ticks; ++tick) {
    run.sliding->advance(scene.ghost(tick));
    if (test_support::on_the_near_side(scene, run.sliding->result().X_WV) < 0.0) return true;
  }
  return false;
}

/// Most trials for the method that promises never to cross.
int trials_of(const SlidingSubject& subject, bool quick) {
  if (quick) return 100;
  return subject.method == haptics::SlidingMethod::kProjection ? 10'000 : 1'000;
}

}  // namespace

void run_sheets(const SlidingBenchOptions& options, Results& results) {
  for (const SlidingSubject& subject : kSlidingSubjects) {
    std::fprintf(stderr, "sliding open-sheets %s\n", subject.name.c_str());
    const int trials = trials_of(subject, options.quick);
    const int crossed = count_trials(trials, [&](std::uint64_t seed) { return crosses(subject, seed); });
    results.add({kSliding, "open-sheets", subject.name, "trials", static_cast<double>(trials), "1"});
    results.add({kSliding, "open-sheets", subject.name, "crossed", static_cast<double>(crossed), "1"});
  }
}

}  // namespace glissade::bench

// See `run_sheets` in benches.h.

#include "benches.h"
#include "sliding_subject.h"

namespace glissade::bench {
namespace {

bool crosses(const SlidingSubject& subject, const test_support::SlidingScene& scene) {
  const SlidingRun run = start(subject, scene);
  for (int tick = 1; tick <= scene.ticks; ++tick) {
    run.sliding->advance(scene.ghost(tick));
    if (test_support::on_the_near_side(scene, run.sliding->result().X_WV) < 0.0) return true;
  }
  return false;
}

}  // namespace

void run_sheets(const SlidingBenchOptions& options, Results& results) {
  const int trials = options.quick ? 100 : 1000;
  for (const SlidingSubject& subject : kSlidingSubjects) {
    int crossed = 0;
    for (int trial = 1; trial <= trials; ++trial)
      crossed += crosses(subject, test_support::sheets_scene(static_cast<std::uint64_t>(trial))) ? 1 : 0;
    results.add({kSliding, "open-sheets", subject.name, "trials", static_cast<double>(trials), "1"});
    results.add({kSliding, "open-sheets", subject.name, "crossed", static_cast<double>(crossed), "1"});
  }
}

}  // namespace glissade::bench

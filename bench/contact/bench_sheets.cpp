// See `register_sheets` in benches.h.

#include <cstdint>

#include <glissade/contact/sliding.h>
#include <glissade/reference/sliding_method.h>

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
  return subject.method == reference::SlidingMethod::kProjection ? 10'000 : 1'000;
}

}  // namespace

void register_sheets(const BenchOptions& options) {
  for (const SlidingSubject& subject : kSlidingSubjects) {
    register_trials("sliding/open-sheets/" + subject.name, trials_of(subject, options.quick), "crossed",
                    [=](std::uint64_t seed) { return crosses(subject, seed); });
  }
}

}  // namespace glissade::bench

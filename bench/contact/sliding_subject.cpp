#include "sliding_subject.h"

#include <glissade/reference/sliding_method.h>

namespace glissade::bench {

SlidingRun start(const SlidingSubject& subject, const test_support::SlidingScene& scene,
                 const contact::SlidingOptions& options) {
  SlidingRun run;
  run.sliding = reference::make_sliding(subject.method, scene.obstacles, scene.part_V, scene.X_WV_start, options);
  return run;
}

}  // namespace glissade::bench

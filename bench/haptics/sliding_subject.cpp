#include "sliding_subject.h"

#include "paper/paper_sliding.h"

namespace glissade::bench {

SlidingRun start(const SlidingSubject& subject, const test_support::SlidingScene& scene,
                 const haptics::SlidingOptions& options) {
  SlidingRun run;
  run.sliding = haptics::make_sliding(subject.method, scene.obstacles, scene.part_V, scene.X_WV_start, options);
  if (const auto* paper = dynamic_cast<const haptics::PaperSliding*>(run.sliding.get())) {
    run.queries = [paper] { return paper->queries(); };
  } else {
    const auto& projection = dynamic_cast<const haptics::Sliding&>(*run.sliding);
    run.queries = [&projection] { return projection.search_statistics().searches; };
  }
  return run;
}

}  // namespace glissade::bench

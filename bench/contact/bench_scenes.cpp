// See `register_scenes` in benches.h.

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include <glissade/reference/sliding_method.h>

#include "benches.h"
#include "sliding_account.h"

namespace glissade::bench {
namespace {

/// Number of ticks. Some take minutes with the paper's method, and the motion of the nut is uniform.
int ticks_of(const test_support::SlidingScene& scene, bool quick) {
  if (scene.name == "nut") return std::min(scene.ticks, quick ? 50 : 1000);
  if (scene.name.ends_with("50k")) return std::min(scene.ticks, quick ? 400 : 1500);
  return std::min(scene.ticks, quick ? 1000 : 3000);
}

}  // namespace

void register_scenes(const BenchOptions& options) {
  for (const std::string& name : test_support::sliding_scene_names()) {
    const auto scene = lazy([=] { return test_support::make_sliding_scene(name); });
    for (const SlidingSubject& subject : kSlidingSubjects) {
      const auto account = std::make_shared<std::optional<SlidingAccount>>();  // of the first run, as of all
      const auto run_scene = [=, quick = options.quick](benchmark::State& state) {
        for (auto _ : state) {
          const PacedRun run = run_paced(subject, **scene, ticks_of(**scene, quick));
          run.report_times(state);
          if (!*account) *account = account_of(run, **scene);
          (*account)->report(state);
        }
      };
      auto* const bench = register_run("sliding/" + name + "/" + subject.name, run_scene)->UseManualTime();
      if (subject.method == reference::SlidingMethod::kPaper) bench->Repetitions(1);  // some take a minute
    }
  }
}

}  // namespace glissade::bench

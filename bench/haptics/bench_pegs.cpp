// See `run_pegs` in benches.h.

#include <array>
#include <cstdio>
#include <numbers>

#include "benches.h"
#include "sliding_subject.h"
#include "trials.h"

namespace glissade::bench {
namespace {

constexpr double kInserted_m = 7e-3;       // the ghost goes 8 mm deep
constexpr int kSearchMilliseconds = 2000;  // duration of a spiral search

/// One setting of the trials with pegs.
struct PegSetting {
  const char* name;
  const SlidingSubject& subject;
  int trials;
  double offset_m;
  double tilt_deg;
  int more_ticks;  ///< with the ghost at rest at the bottom
  bool spiral_search;
};

const std::array<PegSetting, 4> kSettings{
    PegSetting{"pegs-0.3mm-0.5deg", kSlidingSubjects[0], 200, 0.3e-3, 0.5, 0, false},
    PegSetting{"pegs-0.3mm-0.5deg", kSlidingSubjects[1], 50, 0.3e-3, 0.5, 0, false},
    PegSetting{"pegs-1mm-1.5deg", kSlidingSubjects[0], 200, 1e-3, 1.5, kSearchMilliseconds, false},
    PegSetting{"pegs-1mm-1.5deg-spiral-search", kSlidingSubjects[0], 200, 1e-3, 1.5, kSearchMilliseconds, true}};

bool is_inserted(const PegSetting& setting, std::uint64_t seed) {
  const double tilt = setting.tilt_deg * std::numbers::pi / 180.0;
  const test_support::SlidingScene scene = test_support::peg_scene({setting.offset_m, tilt, seed});
  const SlidingRun run = start(setting.subject, scene, {.rules = {.spiral_search = setting.spiral_search}});
  for (int tick = 1; tick <= scene.ticks + setting.more_ticks; ++tick)
    run.sliding->advance(scene.ghost(tick));
  return run.sliding->result().X_WV.translation().z() < -kInserted_m;
}

}  // namespace

void run_pegs(const SlidingBenchOptions& options, Results& results) {
  for (const PegSetting& setting : kSettings) {
    std::fprintf(stderr, "sliding %s %s\n", setting.name, setting.subject.name.c_str());
    const int trials = options.quick ? 2 : setting.trials;
    const int inserted = count_trials(trials, [&](std::uint64_t seed) { return is_inserted(setting, seed); });
    results.add({kSliding, setting.name, setting.subject.name, "trials", static_cast<double>(trials), "1"});
    results.add({kSliding, setting.name, setting.subject.name, "inserted", static_cast<double>(inserted), "1"});
  }
}

}  // namespace glissade::bench

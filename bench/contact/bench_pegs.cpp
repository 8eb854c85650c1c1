// See `register_pegs` in benches.h.

#include <array>
#include <cstdint>
#include <numbers>
#include <string>

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

const std::array<PegSetting, 4> kPegSettings{
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

void register_pegs(const BenchOptions& options) {
  for (const PegSetting& setting : kPegSettings) {
    register_trials(std::string("sliding/") + setting.name + "/" + setting.subject.name,
                    options.quick ? 2 : setting.trials, "inserted",
                    [&setting](std::uint64_t seed) { return is_inserted(setting, seed); });
  }
}

}  // namespace glissade::bench

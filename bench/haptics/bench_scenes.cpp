// See `run_scenes` in benches.h.

#include <algorithm>
#include <cstdio>

#include "benches.h"
#include "sliding_account.h"

namespace glissade::bench {
namespace {

/// Number of ticks. The nut takes minutes, and its motion is uniform.
int ticks_of(const test_support::SlidingScene& scene, bool quick) {
  if (scene.name == "nut") return std::min(scene.ticks, quick ? 50 : 1000);
  if (scene.name.ends_with("50k") && quick) return std::min(scene.ticks, 400);
  return std::min(scene.ticks, quick ? 1000 : 3000);
}

void add(const std::string& scene, const std::string& subject, const SlidingAccount& account, Results& results) {
  const auto row = [&](const char* metric, double value, const char* unit) {
    results.add({kSliding, scene, subject, metric, value, unit});
  };
  row("ticks", account.ticks, "1");
  row("colliding_poses", account.colliding_poses, "1");
  row("final_stretch", 1e3 * account.final_stretch_m, "mm");
  row("mean_stretch", 1e3 * account.mean_stretch_m, "mm");
  row("jammed_ticks", account.jammed_ticks, "1");
  row("force_jump", account.force_jump_N, "N");
  row("force_jump_of_bound", account.force_jump_of_bound, "x");
  row("queries_per_tick", account.queries_per_tick, "1");
}

}  // namespace

void run_scenes(const SlidingBenchOptions& options, Results& results) {
  const std::vector<std::string>& names = options.scenes.empty() ? test_support::sliding_scene_names() : options.scenes;
  for (const std::string& name : names) {
    const test_support::SlidingScene scene = test_support::make_sliding_scene(name);
    const int ticks = ticks_of(scene, options.quick);
    std::vector<SlidingAccount> accounts;
    for (const SlidingSubject& subject : kSlidingSubjects) {
      std::fprintf(stderr, "sliding %s %s\n", name.c_str(), subject.name.c_str());
      accounts.push_back(account_of(subject, scene, ticks));
      add(name, subject.name, accounts.back(), results);
    }
    // Methods take turns, so that a slow moment of the machine affects both. Events of a single run, such as a wait for
    // the search thread, count too.
    std::vector<std::vector<double>> times(kSlidingSubjects.size());
    const int rounds = options.quick ? 1 : 3;
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t i = 0; i < kSlidingSubjects.size(); ++i) {
        const std::vector<double> ticks_us = run_paced(kSlidingSubjects[i], scene, ticks).tick_us;
        for (std::size_t tick = 0; tick < ticks_us.size(); ++tick) {
          if (accounts.front().pushes[tick] != 0) times[i].push_back(ticks_us[tick]);
        }
      }
    }
    if (times.front().empty()) continue;  // nothing has touched anything
    for (std::size_t i = 0; i < kSlidingSubjects.size(); ++i) {
      results.add({kSliding, name, kSlidingSubjects[i].name, "tick_p50", quantile(times[i], 0.5), "us"});
      results.add({kSliding, name, kSlidingSubjects[i].name, "tick_p99", quantile(times[i], 0.99), "us"});
    }
  }
}

}  // namespace glissade::bench

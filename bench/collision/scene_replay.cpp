#include "scene_replay.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <thread>
#include <utility>

#include "register_bench.h"

namespace glissade::bench {
namespace {

using benchmark::State;
using collision::FrameReport;
using collision::StageReport;

struct Stage {
  const char* name;
  StageReport FrameReport::*report;
};
constexpr std::array<Stage, 4> kStages{{{"queue", &FrameReport::queue},
                                        {"neighbor_finding", &FrameReport::neighbor_finding},
                                        {"separating_planes", &FrameReport::separating_planes},
                                        {"exact", &FrameReport::exact}}};

std::vector<NumberPair> in_order(std::vector<NumberPair> pairs) {
  for (NumberPair& pair : pairs) {
    if (pair.second < pair.first) std::swap(pair.first, pair.second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::ptrdiff_t differences(const Replay::Meeting& ours, const Replay::Meeting& theirs) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    std::vector<NumberPair> in_one;
    std::set_symmetric_difference(ours[i].begin(), ours[i].end(), theirs[i].begin(), theirs[i].end(),
                                  std::back_inserter(in_one));
    count += std::ssize(in_one);
  }
  return count;
}

// Takes a pass without measuring it, to fill the caches. Subjects without a report do without: they are slow.
void count_stages(Replay& replay, State& state) {
  const auto mean = [&, frames = static_cast<double>(replay.film().frames.size())](const std::string& name,
                                                                                   auto value) {
    state.counters[name] += static_cast<double>(value) / frames;
  };
  replay.pass([&](const SceneSubject& subject) {
    const FrameReport& report = *subject.report();
    mean("neighbors", report.neighbors);
    for (const Stage& stage : kStages) {
      const StageReport& of_stage = report.*stage.report;
      mean(std::string(stage.name) + "_in", of_stage.in);
      mean(std::string(stage.name) + "_out", of_stage.out);
      mean(std::string(stage.name) + "_us", 1e-3 * static_cast<double>(of_stage.time.count()));
    }
  });
}

void run(State& state, const SceneCase& scene_case, Replay& replay, const Replay& reference) {
  const auto pause = [&](const SceneSubject&) {
    state.PauseTiming();
    std::this_thread::sleep_for(std::chrono::milliseconds(scene_case.pause_ms));
    state.ResumeTiming();
  };
  if (replay.has_report()) count_stages(replay, state);
  for (auto _ : state) {
    if (scene_case.pause_ms > 0) {
      replay.pass(pause);
    } else {
      replay.pass([](const SceneSubject&) {});
    }
  }
  const std::size_t frames = replay.film().frames.size();
  std::size_t meeting = 0;
  for (const std::vector<NumberPair>& pairs : replay.meeting())
    meeting += pairs.size();
  state.counters["frame"] = seconds_each(frames);
  state.counters["meeting"] = static_cast<double>(meeting) / static_cast<double>(frames);
  if (&replay != &reference)
    state.counters["disagreements"] = static_cast<double>(differences(replay.meeting(), reference.meeting()));
}

}  // namespace

Film film(Scene scene, std::size_t frames) {
  Film film{std::move(scene), std::vector<std::vector<MovedObject>>(frames)};
  for (std::size_t i = 0; i < frames; ++i)
    moved_objects(film.scene, static_cast<int>(i), film.frames[i]);
  return film;
}

Film film_with_bounces(Scene scene, std::size_t frames, SceneCast& cast) {
  const std::unique_ptr<SceneSubject> referee = cast.start(glissade_scenes(1), scene);
  std::vector<MovedObject> moved;
  for (int frame = 0; frame < static_cast<int>(frames); ++frame) {
    moved_objects(scene, frame, moved);
    referee->step(moved);
    for (const auto& [a, b] : in_order(referee->meeting()))
      bounce(scene[a], scene[b], frame * kFrame_s);
  }
  return film(std::move(scene), frames);
}

Replay::Replay(SceneCast& cast, const SceneLibrary& library, const Film& film)
    : film_(film), subject_(cast.start(library, film.scene)) {
  pass([this](const SceneSubject& subject) { meeting_.push_back(in_order(subject.meeting())); });
}

void register_scenes(const SceneCase& scene_case, const std::vector<SceneLibrary>& libraries) {
  std::shared_ptr<Lazy<Replay>> reference;
  for (const SceneLibrary& library : libraries) {
    const auto replay = lazy([=] { return Replay(**scene_case.cast, library, **scene_case.film); });
    if (!reference) reference = replay;
    auto* const bench = register_bench(scene_case.name + "/" + library.name,
                                       [=](State& state) { run(state, scene_case, **replay, **reference); });
    if (scene_case.is_real_time) bench->UseRealTime();
  }
}

}  // namespace glissade::bench

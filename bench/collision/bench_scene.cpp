// See `run_scene` in benches.h.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <map>

#include "benches.h"
#include "interleaved_passes.h"
#include "scene_cast.h"
#include "scene_replay.h"

namespace glissade::bench {
namespace {

using collision::FrameReport;
using collision::StageReport;

constexpr const char* kSceneName = "scene";
// Fraction of the box that the bounding spheres of the objects fill.
constexpr double kFilled = 0.12;

using Records = std::vector<std::vector<FrameRecord>>;

template <typename Value>
double mean(const std::vector<FrameRecord>& frames, const Value& value) {
  double sum = 0.0;
  for (const FrameRecord& frame : frames)
    sum += static_cast<double>(value(frame));
  return sum / static_cast<double>(frames.size());
}

struct Stage {
  const char* name;
  StageReport FrameReport::*report;
};
constexpr std::array<Stage, 4> kStages{{{"queue", &FrameReport::queue},
                                        {"neighbor_finding", &FrameReport::neighbor_finding},
                                        {"separating_planes", &FrameReport::separating_planes},
                                        {"exact", &FrameReport::exact}}};

double median_stage_us(const std::vector<FrameRecord>& frames, const Stage& stage) {
  std::vector<double> us;
  for (const FrameRecord& frame : frames)
    us.push_back(1e-3 * static_cast<double>((frame.report.*stage.report).time.count()));
  return median(std::move(us));
}

// The rows of one scene.
class SceneRows {
 public:
  SceneRows(std::string case_name, Results& results) : case_(std::move(case_name)), results_(results) {}

  void add_frames(const std::string& subject, const std::vector<FrameRecord>& frames) {
    row(subject, "us_per_frame", median_us(frames, frames), "us");
    row(subject, "us_per_frame_mean", mean_us(frames, frames), "us");
    row(subject, "us_per_frame_p99", percentile_99_us(frames), "us");
    row(subject, "frames", static_cast<double>(frames.size()), "1");
    row(subject, "meeting", mean(frames, [](const FrameRecord& frame) { return frame.meeting.size(); }), "1");
  }

  // Means over the frames of the pairs that enter and leave a stage, medians of the times.
  void add_stages(const std::string& subject, const std::vector<FrameRecord>& frames) {
    row(subject, "neighbors", mean(frames, [](const FrameRecord& frame) { return frame.report.neighbors; }), "1");
    for (const Stage& stage : kStages) {
      const auto of = [&](const FrameRecord& frame) -> const StageReport& { return frame.report.*stage.report; };
      const std::string name = stage.name;
      row(subject, name + "_in", mean(frames, [&](const FrameRecord& frame) { return of(frame).in; }), "1");
      row(subject, name + "_out", mean(frames, [&](const FrameRecord& frame) { return of(frame).out; }), "1");
      row(subject, name + "_us", median_stage_us(frames, stage), "us");
    }
  }

  // Ratios of the other subjects to the first, Glissade, on the frames that both have. Medians are the time of a
  // typical frame; a subject with memory may have a few slow frames, which only means include.
  void add_ratios(const std::vector<SceneLibrary>& libraries, const Records& records) {
    add_ratios_of(median_us, "ratio_to_", libraries, records);
    add_ratios_of(mean_us, "mean_ratio_to_", libraries, records);
    for (std::size_t i = 1; i < libraries.size(); ++i)
      row(libraries[i].name, "disagreements", static_cast<double>(differences(records[0], records[i])), "1");
  }

 private:
  using CommonTime = double (*)(std::span<const FrameRecord> frames, std::span<const FrameRecord> others);

  void add_ratios_of(CommonTime time_us, const std::string& prefix, const std::vector<SceneLibrary>& libraries,
                     const Records& records) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < libraries.size(); ++i) {
      const double ratio = time_us(records[i], records[0]) / time_us(records[0], records[i]);
      best = std::min(best, ratio);
      row(libraries[0].name, prefix + libraries[i].name, ratio, "x");
    }
    row(libraries[0].name, prefix + "best_peer", best, "x");
  }

  void row(const std::string& subject, const std::string& metric, double value, const std::string& unit) {
    results_.add({kSceneName, case_, subject, metric, value, unit});
  }

  std::string case_;
  Results& results_;
};

void say(const std::string& case_name, const std::vector<SceneLibrary>& libraries, const Records& records) {
  std::fprintf(stderr, "%s %s:", kSceneName, case_name.c_str());
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    std::fprintf(stderr, " %s %.4g us", libraries[i].name.c_str(), median_us(records[i], records[i]));
    if (i == 0) continue;
    std::fprintf(stderr, " (%.1fx)", median_us(records[i], records[0]) / median_us(records[0], records[i]));
    if (const auto wrong = differences(records[0], records[i]); wrong > 0) {
      std::fprintf(stderr, " [%lld pairs differ in %zu frames]", static_cast<long long>(wrong), records[i].size());
    }
  }
  std::fputc('\n', stderr);
}

// Processor time divided by wall-clock time. Below 1 the machine has other work, and slow subjects look slower than
// they are: their frames are longer than the time between interruptions, while fast frames fall between them.
class CpuShare {
 public:
  double value() const {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    return static_cast<double>(std::clock() - cpu_at_start_) / CLOCKS_PER_SEC / passed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t cpu_at_start_ = std::clock();
};

// Objects that bounce off each other, or pass through each other.
void run_objects(const SceneCast& cast, std::size_t count, bool off_each_other, const BenchOptions& options,
                 Results& results) {
  const std::string case_name = (off_each_other ? "objects-" : "through-") + std::to_string(count);
  const ReplayLimits limits = options.quick ? ReplayLimits{.frames = 200, .seconds = 1.0} : ReplayLimits{};
  Scene scene = off_each_other ? objects_apart(cast.radii(), count, kFilled, options.seed)
                               : objects_in_box(cast.radii(), count, kFilled, options.seed);
  if (off_each_other) play(scene, *cast.start(scene)[0], limits.run_in + limits.frames);
  const auto subjects = cast.start(scene);
  const CpuShare cpu_share;
  const Records records = replay(scene, subjects, limits);
  results.add({kSceneName, case_name, "machine", "cpu_share", cpu_share.value(), "1"});
  SceneRows rows(case_name, results);
  for (std::size_t i = 0; i < records.size(); ++i)
    rows.add_frames(cast.libraries()[i].name, records[i]);
  rows.add_stages(cast.libraries()[0].name, records[0]);
  rows.add_ratios(cast.libraries(), records);
  say(case_name, cast.libraries(), records);
}

// Geometric means and minima of the ratios of all cases, for medians and for means.
void add_means(Results& results) {
  std::map<std::string, std::vector<double>> ratios;
  for (const Row& row : results.rows()) {
    if (row.bench == kSceneName && row.metric.find("ratio_to_") != std::string::npos)
      ratios[row.metric].push_back(row.value);
  }
  for (const auto& [metric, values] : ratios) {
    results.add({kSceneName, "geomean", "glissade", metric, geometric_mean(values), "x"});
    results.add({kSceneName, "worst", "glissade", metric, *std::min_element(values.begin(), values.end()), "x"});
  }
}

// Cost of objects at rest: both scenes take turns.
void run_resting(const BenchOptions& options, Results& results) {
  const SceneCast cast({glissade_scenes(1)}, options);
  const std::array<std::size_t, 2> resting{10, 1000};
  std::vector<Scene> scenes;
  std::vector<std::unique_ptr<SceneSubject>> subjects;
  for (const std::size_t count : resting) {
    scenes.push_back(one_among_resting(cast.radii(), count, kFilled, options.seed));
    subjects.push_back(std::move(cast.start(scenes.back())[0]));
  }
  // In both scenes only object 0 moves, and in the same way.
  const Records records = replay(scenes[0], subjects, {.frames = options.quick ? 1000 : 4000});
  for (std::size_t i = 0; i < records.size(); ++i) {
    SceneRows rows("rest-" + std::to_string(resting[i]), results);
    rows.add_frames("glissade", records[i]);
    rows.add_stages("glissade", records[i]);
  }
  const auto time = [](const FrameRecord& frame) { return frame.us; };
  const double ratio = median_us(records[1], records[0]) / median_us(records[0], records[1]);
  results.add({kSceneName, "rest-1000", "glissade", "time_by_rest-10", ratio, "x"});
  results.add({kSceneName, "rest-1000", "glissade", "mean_time_by_rest-10",
               mean(records[1], time) / mean(records[0], time), "x"});
  std::fprintf(stderr, "%s: one moves among 10 that rest %.3g us, among 1000 %.3g us (%.2f times)\n", kSceneName,
               median_us(records[0], records[0]), median_us(records[1], records[1]), ratio);
}

}  // namespace

void run_scene(const BenchOptions& options, Results& results) {
  {
    const SceneCast cast({glissade_scenes(1), fcl_scenes(), ode_scenes(), bullet_scenes()}, options);
    std::vector<std::size_t> counts{10, 30, 100};
    if (!options.quick) counts.insert(counts.end(), {300, 1000});
    for (const std::size_t count : counts)
      run_objects(cast, count, true, options, results);
    for (const std::size_t count : counts) {
      if (count >= 100) run_objects(cast, count, false, options, results);
    }
  }
  add_means(results);
  run_resting(options, results);
}

}  // namespace glissade::bench

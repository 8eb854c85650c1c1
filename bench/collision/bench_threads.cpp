// See `run_threads` in benches.h.

#include <chrono>
#include <cstdio>
#include <thread>

#include <oneapi/tbb/task_arena.h>

#include "benches.h"
#include "interleaved_passes.h"
#include "pose_source.h"
#include "query/parallel_query.h"
#include "scene_cast.h"
#include "scene_replay.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using collision::TrianglePair;
using Clock = std::chrono::steady_clock;

constexpr const char* kThreadsName = "threads";

// 1, 2, 4 and 8, up to the number of processors, but always 1 and 2, for a comparison.
std::vector<int> thread_counts() {
  std::vector<int> counts{1, 2};
  for (const int count : {4, 8}) {
    if (count <= static_cast<int>(std::thread::hardware_concurrency())) counts.push_back(count);
  }
  return counts;
}

// The times on 1, 2 ... threads.
void add_rows(const std::string& case_name, const std::vector<double>& us, std::int64_t disagreements,
              const std::string& metric, Results& results) {
  const std::vector<int> counts = thread_counts();
  std::fprintf(stderr, "%s %s:", kThreadsName, case_name.c_str());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string subject = glissade_scenes(counts[i]).name;
    results.add({kThreadsName, case_name, subject, metric, us[i], "us"});
    std::fprintf(stderr, " %s %.4g us", subject.c_str(), us[i]);
    if (i == 0) continue;
    results.add({kThreadsName, case_name, subject, "speedup", us[0] / us[i], "x"});
    std::fprintf(stderr, " (%.2fx)", us[0] / us[i]);
  }
  results.add({kThreadsName, case_name, "glissade", "disagreements", static_cast<double>(disagreements), "1"});
  std::fputc('\n', stderr);
}

// The amount of work: means over the frames.
void add_counts(const std::string& case_name, const std::vector<FrameRecord>& frames, Results& results) {
  double neighbors = 0.0;
  double exact = 0.0;
  for (const FrameRecord& frame : frames) {
    neighbors += static_cast<double>(frame.report.neighbors) / static_cast<double>(frames.size());
    exact += static_cast<double>(frame.report.exact.in) / static_cast<double>(frames.size());
  }
  results.add({kThreadsName, case_name, "glissade", "neighbors", neighbors, "1"});
  results.add({kThreadsName, case_name, "glissade", "exact_in", exact, "1"});
}

// In turns of one frame, the threads of the last frame have gone to sleep, and caches hold the objects of the others,
// as in a loop with pauses. In longer turns frames follow each other directly, as in a loop without pauses.
constexpr int kFramesOfLongTurns = 20;

void run_scene_of(const SceneCast& cast, const std::string& case_name, std::size_t objects, double filled, int turn,
                  const BenchOptions& options, Results& results) {
  const Scene scene = objects_in_box(cast.radii(), objects, filled, options.seed);
  const auto records = replay(scene, cast.start(scene),
                              {.frames = options.quick ? 60 : 300,
                               .turn = turn,
                               .warm_up = turn > 1 ? 1 : 0,
                               .seconds = options.quick ? 1.0 : 5.0});
  std::vector<double> us;
  std::int64_t disagreements = 0;
  for (const std::vector<FrameRecord>& of_subject : records) {
    us.push_back(median_us(of_subject, records[0]));
    disagreements += differences(of_subject, records[0]);
  }
  add_rows(case_name, us, disagreements, "us_per_frame", results);
  add_counts(case_name, records[0], results);
}

void run_scenes(const BenchOptions& options, Results& results) {
  std::vector<SceneLibrary> libraries;
  for (const int threads : thread_counts())
    libraries.push_back(glissade_scenes(threads));
  const SceneCast cast(libraries, options);
  run_scene_of(cast, "dense", 1000, 0.5, kFramesOfLongTurns, options, results);
  run_scene_of(cast, "dense-with-pauses", 1000, 0.5, 1, options, results);
  run_scene_of(cast, "sparse", 30, 0.12, kFramesOfLongTurns, options, results);
  run_scene_of(cast, "sparse-with-pauses", 30, 0.12, 1, options, results);
}

// All pairs of triangles of one mesh at one pose, by a number of threads.
class PairQuery {
 public:
  explicit PairQuery(int threads) : threads_(threads), arena_(threads) {}

  double us(const DopTree& tree, const Eigen::Isometry3d& X_AB) {
    const Clock::time_point start = Clock::now();
    if (threads_ == 1) {
      collision::intersecting_pairs(tree, tree, X_AB, alone_, pairs_);
    } else {
      arena_.execute([&] { collision::intersecting_pairs(tree, tree, X_AB, together_, pairs_); });
    }
    return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  }

  const std::vector<TrianglePair>& pairs() const { return pairs_; }

 private:
  int threads_;
  oneapi::tbb::task_arena arena_;
  collision::QueryWorkspace alone_;
  collision::ParallelWorkspace together_;
  std::vector<TrianglePair> pairs_;
};

std::vector<PairQuery> pair_queries() {
  std::vector<PairQuery> queries;
  for (const int threads : thread_counts())
    queries.emplace_back(threads);
  return queries;
}

struct PairTimes {
  std::vector<double> us = std::vector<double>(thread_counts().size());  ///< sums over meshes and poses
  std::int64_t disagreements = 0;
};

void time_pairs(const DopTree& tree, const Eigen::Isometry3d& X_AB, int rounds, std::vector<PairQuery>& queries,
                PairTimes& times) {
  std::vector<std::vector<double>> us(queries.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < queries.size(); ++i)
      us[i].push_back(queries[i].us(tree, X_AB));
  }
  for (std::size_t i = 0; i < queries.size(); ++i) {
    times.us[i] += median(us[i]);
    times.disagreements += queries[i].pairs() == queries[0].pairs() ? 0 : 1;
  }
}

// Two copies of every shape that overlap widely.
void run_pairs(std::int64_t triangles, const BenchOptions& options, Results& results) {
  std::vector<PairQuery> queries = pair_queries();
  PairTimes times;
  for (const SuiteMesh& mesh : suite_meshes(options.suite, {triangles})) {
    const DopTree tree(std::make_shared<const geometry::TriangleMesh>(mesh.make()));
    PoseSource source(tree, tree, options.seed);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d shift = 0.1 * kSize * source.direction();
      time_pairs(tree, pose(source.rotation(), shift), options.quick ? 5 : 15, queries, times);
    }
  }
  add_rows("pairs-" + short_count(triangles), times.us, times.disagreements, "us_all_queries", results);
}

}  // namespace

void run_threads(const BenchOptions& options, Results& results) {
  run_scenes(options, results);
  for (const std::int64_t triangles : options.suite.thread_triangles)
    run_pairs(triangles, options, results);
}

}  // namespace glissade::bench

// See `register_threads` in benches.h.

#include <numeric>
#include <thread>

#include <oneapi/tbb/task_arena.h>

#include "benches.h"
#include "pose_source.h"
#include "query/parallel_query.h"
#include "register_bench.h"
#include "scene_replay.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using collision::TrianglePair;

// 1, 2, 4 and 8, up to the number of processors, but always 1 and 2, for a comparison.
std::vector<int> thread_counts() {
  std::vector<int> counts{1, 2};
  for (const int count : {4, 8}) {
    if (count <= static_cast<int>(std::thread::hardware_concurrency())) counts.push_back(count);
  }
  return counts;
}

// Two copies of every shape that overlap widely.
struct Overlap {
  std::shared_ptr<const DopTree> tree;
  Eigen::Isometry3d X_AB;
};

std::vector<Overlap> overlaps(std::int64_t triangles) {
  std::vector<Overlap> all;
  for (geometry::TriangleMesh& mesh : all_shapes(triangles, kSize)) {
    const auto tree = std::make_shared<const DopTree>(std::make_shared<const geometry::TriangleMesh>(std::move(mesh)));
    PoseSource source(*tree, *tree, kSeed);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d shift = 0.1 * kSize * source.direction();
      all.push_back({tree, pose(source.rotation(), shift)});
    }
  }
  return all;
}

// All pairs of triangles of each overlap, by a number of threads.
class PairFinder {
 public:
  PairFinder(const std::vector<Overlap>& overlaps, int threads)
      : overlaps_(overlaps), threads_(threads), arena_(threads), pairs_(overlaps.size()) {
    pass();
  }

  void pass() {
    for (std::size_t i = 0; i < overlaps_.size(); ++i) {
      const DopTree& tree = *overlaps_[i].tree;
      const Eigen::Isometry3d& X_AB = overlaps_[i].X_AB;
      if (threads_ == 1) {
        collision::intersecting_pairs(tree, tree, X_AB, alone_, pairs_[i]);
      } else {
        arena_.execute([&] { collision::intersecting_pairs(tree, tree, X_AB, together_, pairs_[i]); });
      }
    }
  }

  /// Of each overlap.
  const std::vector<std::vector<TrianglePair>>& pairs() const { return pairs_; }

 private:
  const std::vector<Overlap>& overlaps_;
  int threads_;
  oneapi::tbb::task_arena arena_;
  collision::QueryWorkspace alone_;
  collision::ParallelWorkspace together_;
  std::vector<std::vector<TrianglePair>> pairs_;
};

void register_pairs(std::int64_t triangles) {
  const auto all = lazy([triangles] { return overlaps(triangles); });
  const auto reference = lazy([all] { return std::make_unique<PairFinder>(**all, 1); });
  for (const int threads : thread_counts()) {
    const auto finder = threads == 1 ? reference : lazy([=] { return std::make_unique<PairFinder>(**all, threads); });
    const auto run = [=](benchmark::State& state) {
      PairFinder& ours = ***finder;
      const auto& expected = (**reference)->pairs();
      for (auto _ : state)
        ours.pass();
      state.counters["query"] = seconds_each(expected.size());
      if (threads > 1) {
        state.counters["disagreements"] = std::inner_product(expected.begin(), expected.end(), ours.pairs().begin(),
                                                             0.0, std::plus<>(), std::not_equal_to<>());
      }
    };
    register_bench("threads/pairs-" + short_count(triangles) + "/" + glissade_scenes(threads).name, run)->UseRealTime();
  }
}

}  // namespace

void register_threads(const Suite& suite) {
  std::vector<SceneLibrary> libraries;
  for (const int threads : thread_counts())
    libraries.push_back(glissade_scenes(threads));
  const auto cast = lazy([] { return SceneCast(); });
  const auto film_of = [=](std::size_t objects, double filled, std::size_t frames) {
    return lazy([=] { return film(objects_in_box((*cast)->radii(), objects, filled, kSeed), frames); });
  };
  // Without pauses the threads wait for the next frame; in a pause they go to sleep.
  register_scenes({"threads/dense", cast, film_of(1000, 0.5, 30), 0, true}, libraries);
  register_scenes({"threads/dense-with-pauses", cast, film_of(1000, 0.5, 30), 1, true}, libraries);
  register_scenes({"threads/sparse", cast, film_of(30, 0.12, 1000), 0, true}, libraries);
  register_pairs(50'000);
  if (!suite.quick) register_pairs(200'000);
}

}  // namespace glissade::bench

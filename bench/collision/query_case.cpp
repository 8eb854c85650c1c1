#include "query_case.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>

#include "register_bench.h"

namespace glissade::bench {
namespace {

using benchmark::State;
using collision::DopTree;
using collision::QueryCounters;
using Eigen::Isometry3d;

double answer(Query& query, const Isometry3d& X_AB, Operation operation) {
  if (operation == Operation::kIntersects) return query.intersects(X_AB) ? 1.0 : 0.0;
  if (operation == Operation::kCountPairs) return static_cast<double>(query.count_pairs(X_AB));
  return std::max(0.0, query.distance(X_AB));
}

// Other subjects have filled the caches with their own models.
void warm_up(Query& query, const Poses& poses, Operation operation) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(2);
  query.prepare();
  for (auto X_AB = poses.begin(); X_AB != poses.end() && Clock::now() < end; ++X_AB)
    answer(query, *X_AB, operation);
}

// A subject in a case, with its answers.
class Contestant {
 public:
  Contestant(const QueryCase& query_case, const Subject& subject) : query_((*query_case.meshes)->query(subject)) {
    query_->prepare();
    query_->forget();
    for (const Isometry3d& X_AB : **query_case.poses) {
      answers_.push_back(answer(*query_, X_AB, query_case.operation));
      const std::optional<QueryCounters> counters = query_->counters();
      if (!counters) continue;
      if (!work_) work_.emplace();
      work_->node_tests += counters->node_tests;
      work_->realignments += counters->realignments;
      work_->triangle_tests += counters->triangle_tests;
    }
  }

  Query& query() { return *query_; }

  void count(const QueryCase& query_case, State& state) const {
    const auto poses = static_cast<double>(answers_.size());
    const double sum = std::accumulate(answers_.begin(), answers_.end(), 0.0);
    if (query_case.operation == Operation::kIntersects) state.counters["colliding"] = sum;
    if (query_case.operation == Operation::kCountPairs) state.counters["pairs"] = sum / poses;
    if (!work_) return;
    state.counters["node_tests"] = static_cast<double>(work_->node_tests) / poses;
    state.counters["realignments"] = static_cast<double>(work_->realignments) / poses;
    state.counters["triangle_tests"] = static_cast<double>(work_->triangle_tests) / poses;
  }

  // Verdicts and counts are whole numbers; distances may differ by a rounding.
  int disagreements(const Contestant& reference) const {
    constexpr double kRounding = 1e-6;
    return std::inner_product(answers_.begin(), answers_.end(), reference.answers_.begin(), 0, std::plus<>(),
                              [](double a, double b) { return std::abs(a - b) <= kRounding ? 0 : 1; });
  }

 private:
  std::unique_ptr<Query> query_;
  std::vector<double> answers_;
  std::optional<QueryCounters> work_;  // sums
};

void run(State& state, const QueryCase& query_case, Lazy<Contestant>& contestant, Lazy<Contestant>& reference) {
  const Poses& poses = **query_case.poses;
  if (poses.empty()) return state.SkipWithError("no such poses were found");
  if (&contestant == &reference) {
    state.counters["triangles"] = static_cast<double>((*query_case.meshes)->mesh_A->triangles.size());
    state.counters["poses"] = static_cast<double>(poses.size());
  } else {
    state.counters["disagreements"] = contestant->disagreements(*reference);
  }
  contestant->count(query_case, state);
  measure_passes(state, contestant->query(), poses, query_case.operation);
}

}  // namespace

std::shared_ptr<Lazy<Poses>> lazy_poses(const std::shared_ptr<Lazy<MeshPair>>& meshes, PosesOfTrees make) {
  return lazy([meshes, make = std::move(make)] {
    const MeshPair& pair = **meshes;
    const DopTree tree_A(pair.mesh_A);
    if (pair.mesh_A == pair.mesh_B) return make(tree_A, tree_A);
    return make(tree_A, DopTree(pair.mesh_B));
  });
}

void measure_passes(State& state, Query& query, const Poses& poses, Operation operation) {
  warm_up(query, poses, operation);
  for (auto _ : state) {
    query.forget();
    for (const Isometry3d& X_AB : poses)
      benchmark::DoNotOptimize(answer(query, X_AB, operation));
  }
  state.counters["query"] = seconds_each(poses.size());
}

void register_queries(const QueryCase& query_case, const std::vector<Subject>& subjects) {
  std::shared_ptr<Lazy<Contestant>> reference;
  for (const Subject& subject : subjects) {
    const auto contestant = lazy([query_case, subject] { return Contestant(query_case, subject); });
    if (!reference) reference = contestant;
    register_bench(query_case.name + "/" + subject.name,
                   [=](State& state) { run(state, query_case, *contestant, *reference); });
  }
}

void register_sample(QueryCase query_case, std::size_t series, std::size_t count,
                     const std::vector<Subject>& subjects) {
  query_case.name += "-sample";
  query_case.poses = lazy([poses = query_case.poses, series, count] {
    const Poses& all = **poses;
    Poses sample;
    const std::size_t of_series = all.size() / series;
    const std::size_t taken = std::min(count, of_series);
    for (std::size_t i = 0; i < taken; ++i)
      sample.push_back(all[i * of_series / taken * series + i % series]);
    return sample;
  });
  register_queries(query_case, subjects);
}

}  // namespace glissade::bench

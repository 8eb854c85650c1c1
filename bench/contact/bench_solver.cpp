// See `register_solver` in benches.h.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glissade/contact/projection.h>
#include <glissade/contact/spring.h>

#include "benches.h"

namespace glissade::bench {
namespace {

using contact::ConstraintRow;
using geometry::Displacement;

constexpr contact::CouplingStiffness kStiffness{1000.0, 10.0};
constexpr double kRadius = 0.1;  // metres; k_r = k_t ρ²

/// A part that is pressed and turned against contacts on one side of it, with random normals.
struct Programme {
  geometry::Displacement wanted;
  std::vector<ConstraintRow> rows;
};

Programme random_programme(int rows, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Eigen::Vector3d(uniform(random), uniform(random), uniform(random)); };
  Programme programme;
  programme.wanted = {1e-3 * (0.5 * vector() - Eigen::Vector3d::UnitZ()), 1e-2 * vector()};
  for (int i = 0; i < rows; ++i) {
    const Eigen::Vector3d n = (0.5 * vector() + Eigen::Vector3d::UnitZ()).normalized();
    programme.rows.push_back({n, kRadius * vector(), -1e-5 * (1.0 + uniform(random))});
  }
  return programme;
}

void project(benchmark::State& state, int rows) {
  constexpr int kProgrammes = 300;
  std::mt19937_64 random(static_cast<std::uint64_t>(rows));
  std::vector<Programme> programmes;
  while (programmes.size() < kProgrammes)
    programmes.push_back(random_programme(rows, random));
  contact::ProjectionSolver solver;
  std::int64_t active = 0;
  while (state.KeepRunningBatch(kProgrammes)) {
    for (const Programme& programme : programmes)
      active += solver.project(programme.wanted, kStiffness, programme.rows).active_count;
  }
  using benchmark::Counter;
  const auto count = static_cast<double>(active);
  state.counters["active"] = Counter(count, Counter::kAvgIterations);
  state.counters["time_per_active"] = Counter(count, Counter::kIsRate | Counter::kInvert);
}

}  // namespace

void register_solver(const BenchOptions& /*options*/) {
  for (const int rows : {1, 2, 4, 8, 16, 32, 64}) {
    benchmark::RegisterBenchmark(("sliding/solver-" + std::to_string(rows) + "/glissade").c_str(),
                                 [=](benchmark::State& state) { project(state, rows); });
  }
}

}  // namespace glissade::bench

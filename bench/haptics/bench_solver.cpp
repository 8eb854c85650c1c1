// See `run_solver` in benches.h.

#include <chrono>
#include <random>
#include <vector>

#include "benches.h"
#include "sliding_account.h"
#include "solver/projection.h"

namespace glissade::bench {
namespace {

using geometry::Displacement;
using haptics::ConstraintRow;

constexpr haptics::CouplingStiffness kStiffness{1000.0, 10.0};
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

}  // namespace

void run_solver(const SlidingBenchOptions& options, Results& results) {
  const int passes = options.quick ? 21 : 101;
  for (const int rows : {1, 2, 4, 8, 16, 32, 64}) {
    std::mt19937_64 random(static_cast<std::uint64_t>(rows));
    std::vector<Programme> programmes;
    while (programmes.size() < 300)
      programmes.push_back(random_programme(rows, random));
    haptics::ProjectionSolver solver;
    std::vector<double> pass_us;
    std::int64_t active = 0;
    for (int pass = 0; pass < passes; ++pass) {
      active = 0;
      const auto start = std::chrono::steady_clock::now();
      for (const Programme& programme : programmes)
        active += solver.project(programme.wanted, kStiffness, programme.rows).active_count;
      pass_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    }
    const double us = quantile(pass_us, 0.5);
    const std::string name = "solver-" + std::to_string(rows);
    const auto count = static_cast<double>(programmes.size());
    results.add({kSliding, name, "glissade", "active", static_cast<double>(active) / count, "1"});
    results.add({kSliding, name, "glissade", "time", us / count, "us"});
    results.add({kSliding, name, "glissade", "time_per_active", us / static_cast<double>(active), "us"});
  }
}

}  // namespace glissade::bench

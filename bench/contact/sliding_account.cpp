#include "sliding_account.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include <glissade/contact/spring.h>
#include <glissade/reference/grid_check.h>
#include <glissade/reference/sliding_method.h>

#include "jam_check.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;
using geometry::Displacement;
using geometry::displacement_between;
using geometry::motion_bound;

constexpr double kAhead_m = 0.1e-3;
constexpr double kStandsStill_m = 1e-6;

double stretch(const geometry::Displacement& d, const contact::CouplingStiffness& k) {
  return std::sqrt(d.v.squaredNorm() + k.rotational / k.translational * d.w.squaredNorm());
}

}  // namespace

PacedRun run_paced(const SlidingSubject& subject, const test_support::SlidingScene& scene, int ticks) {
  using Clock = std::chrono::steady_clock;
  const SlidingRun run = start(subject, scene, {.rules = {.has_search_thread = true}});
  reference::SlidingSimulation& sliding = *run.sliding;
  PacedRun paced{.stiffness = sliding.stiffness(),
                 .margin = sliding.margin(),
                 .X_WV = {sliding.result().X_WV},
                 .error = {sliding.lag()}};
  Clock::time_point due = Clock::now();
  for (int tick = 1; tick <= ticks; ++tick) {
    const Isometry3d X_WG = scene.ghost(tick);
    std::this_thread::sleep_until(due);
    const Clock::time_point begin = Clock::now();
    sliding.advance(X_WG);
    const Clock::time_point end = Clock::now();
    if (sliding.result().pushing > 0) paced.times.record(end - begin);
    paced.X_WV.push_back(sliding.result().X_WV);
    paced.error.push_back(sliding.lag());
    due = std::max(end, due + std::chrono::milliseconds(1));
  }
  paced.queries_per_tick = static_cast<double>(run.sliding->queries()) / ticks;
  return paced;
}

void PacedRun::report_times(benchmark::State& state) const {
  times.report_tick(state);
  times.report_ms(state);
}

SlidingAccount account_of(const PacedRun& run, const test_support::SlidingScene& scene) {
  JamCheck jam_check(scene);
  const contact::CouplingStiffness& k = run.stiffness;
  const double radius = scene.part_V->radius();
  const auto motion = [&](const Isometry3d& X_from, const Isometry3d& X_to) {
    return motion_bound(displacement_between(X_from, X_to, scene.part_V->p_Vref()), radius);
  };
  SlidingAccount account;
  account.ticks = static_cast<int>(run.X_WV.size()) - 1;
  std::vector<Isometry3d> poses;
  for (int tick = 1; tick <= account.ticks; ++tick) {
    const auto now = static_cast<std::size_t>(tick);
    const Isometry3d& X_WV = run.X_WV[now];
    const Displacement& error = run.error[now];
    const Displacement& error_before = run.error[now - 1];
    if (poses.empty() || X_WV.matrix() != run.X_WV[now - 1].matrix()) poses.push_back(X_WV);
    account.mean_stretch_m += stretch(error, k) / account.ticks;
    if (motion(run.X_WV[now - 1], X_WV) < kStandsStill_m && motion_bound(error, radius) > kAhead_m &&
        jam_check.could_move(X_WV, error, k, run.margin)) {
      ++account.jammed_ticks;
    }
    const double jump = k.translational * stretch({error.v - error_before.v, error.w - error_before.w}, k);
    const double ghost_motion = motion(scene.ghost(tick - 1), scene.ghost(tick));
    account.force_jump_N = std::max(account.force_jump_N, jump);
    account.force_jump_of_bound =
        std::max(account.force_jump_of_bound, jump / (k.translational * (contact::kSlew_m + ghost_motion)));
  }
  account.final_stretch_m = stretch(run.error.back(), k);
  account.queries_per_tick = run.queries_per_tick;
  account.colliding_poses = count_collisions(scene, poses);
  return account;
}

void SlidingAccount::report(benchmark::State& state) const {
  state.counters["ticks"] = ticks;
  state.counters["colliding_poses"] = colliding_poses;
  state.counters["final_stretch_mm"] = 1e3 * final_stretch_m;
  state.counters["mean_stretch_mm"] = 1e3 * mean_stretch_m;
  state.counters["jammed_ticks"] = jammed_ticks;
  state.counters["force_jump_N"] = force_jump_N;
  state.counters["force_jump_of_bound"] = force_jump_of_bound;
  state.counters["queries_per_tick"] = queries_per_tick;
}

int count_collisions(const test_support::SlidingScene& scene, const std::vector<Isometry3d>& poses_WV) {
  std::vector<reference::PlacedMesh> placed;
  for (const contact::Obstacle& obstacle : scene.obstacles) {
    placed.push_back({std::make_shared<const geometry::TriangleMesh>(obstacle.body->tree.mesh()), obstacle.X_WO});
  }
  const reference::GridCheck check(placed);
  const std::vector<char> collide = check.collisions(scene.part_V->tree.mesh(), poses_WV);
  return static_cast<int>(std::count(collide.begin(), collide.end(), 1));
}

}  // namespace glissade::bench

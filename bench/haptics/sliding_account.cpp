#include "sliding_account.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include <glissade/haptics/coupling.h>
#include <glissade/reference/grid_check.h>

#include "jam_check.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;
using geometry::Displacement;
using geometry::displacement_between;
using geometry::motion_bound;

constexpr double kAhead_m = 0.1e-3;
constexpr double kStandsStill_m = 1e-6;

double stretch(const geometry::Displacement& d, const haptics::CouplingStiffness& k) {
  return std::sqrt(d.v.squaredNorm() + k.rotational / k.translational * d.w.squaredNorm());
}

}  // namespace

SlidingAccount account_of(const SlidingSubject& subject, const test_support::SlidingScene& scene, int ticks) {
  SlidingRun run = start(subject, scene);
  haptics::SlidingSimulation& sliding = *run.sliding;
  JamCheck jam_check(scene);
  const haptics::CouplingStiffness k = sliding.stiffness();
  const double radius = sliding.part().radius();
  const auto& p_Vref = sliding.part().p_Vref();
  SlidingAccount account;
  account.ticks = ticks;
  std::vector<Isometry3d> poses;
  geometry::Displacement error_before = sliding.error();
  for (int tick = 1; tick <= ticks; ++tick) {
    const Isometry3d X_WV_before = sliding.result().X_WV;
    const double ghost_motion = geometry::motion_bound(
        geometry::displacement_between(scene.ghost(tick - 1), scene.ghost(tick), p_Vref), radius);
    sliding.advance(scene.ghost(tick));
    account.pushes.push_back(sliding.result().pushing > 0 ? 1 : 0);

    const Isometry3d& X_WV = sliding.result().X_WV;
    if (poses.empty() || X_WV.matrix() != X_WV_before.matrix()) poses.push_back(X_WV);
    const geometry::Displacement error = sliding.error();
    account.mean_stretch_m += stretch(error, k) / ticks;
    const double moved = geometry::motion_bound(geometry::displacement_between(X_WV_before, X_WV, p_Vref), radius);
    if (moved < kStandsStill_m && geometry::motion_bound(error, radius) > kAhead_m &&
        jam_check.could_move(X_WV, error, k, sliding.margin())) {
      ++account.jammed_ticks;
    }
    const double jump = k.translational * stretch({error.v - error_before.v, error.w - error_before.w}, k);
    account.force_jump_N = std::max(account.force_jump_N, jump);
    account.force_jump_of_bound =
        std::max(account.force_jump_of_bound, jump / (k.translational * (haptics::kSlew_m + ghost_motion)));
    error_before = error;
  }
  account.final_stretch_m = stretch(error_before, k);
  account.queries_per_tick = static_cast<double>(run.queries()) / ticks;
  account.colliding_poses = count_collisions(scene, poses);
  return account;
}

PacedRun run_paced(const SlidingSubject& subject, const test_support::SlidingScene& scene, int ticks) {
  using Clock = std::chrono::steady_clock;
  const SlidingRun run = start(subject, scene, {.rules = {.has_search_thread = true}});
  PacedRun paced;
  Clock::time_point due = Clock::now();
  for (int tick = 1; tick <= ticks; ++tick) {
    std::this_thread::sleep_until(due);
    const Clock::time_point begin = Clock::now();
    run.sliding->advance(scene.ghost(tick));
    const Clock::time_point end = Clock::now();
    paced.tick_us.push_back(std::chrono::duration<double, std::micro>(end - begin).count());
    paced.X_WV.push_back(run.sliding->result().X_WV);
    paced.pushes.push_back(run.sliding->result().pushing > 0 ? 1 : 0);
    due = std::max(end, due + std::chrono::milliseconds(1));
  }
  return paced;
}

int count_collisions(const test_support::SlidingScene& scene, const std::vector<Isometry3d>& poses_WV) {
  std::vector<reference::PlacedMesh> placed;
  for (const haptics::Obstacle& obstacle : scene.obstacles) {
    placed.push_back({std::make_shared<const geometry::TriangleMesh>(obstacle.body->tree.mesh()), obstacle.X_WO});
  }
  const reference::GridCheck check(placed);
  const std::vector<char> collide = check.collisions(scene.part_V->tree.mesh(), poses_WV);
  return static_cast<int>(std::count(collide.begin(), collide.end(), 1));
}

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1))];
}

}  // namespace glissade::bench

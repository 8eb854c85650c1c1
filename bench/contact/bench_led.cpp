// See `register_led` in benches.h.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benches.h"
#include "held_part.h"
#include "pose_source.h"
#include "sliding_account.h"
#include "user_meshes.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::SlidingScene;
using test_support::Waypoint;

constexpr double kLedSpeed = 0.5e-3;       // metres a tick
constexpr double kLedAngularSpeed = 5e-3;  // radians a tick, at most
constexpr double kWandering = 20e-3;       // metres from the start
constexpr double kLedTurn = 0.2;           // radians from the start
constexpr double kExtent = 0.2;            // metres, of the larger of two meshes without a unit
constexpr double kGap = 1e-3;              // metres between them at the start
constexpr std::uint64_t kLedSeed = 1;

// From one random point near the start to the next, each time at constant speed.
std::vector<Waypoint> wander(const Isometry3d& X_WV_start, int ticks, PoseSource& source) {
  std::vector<Waypoint> way{{0, X_WV_start}};
  while (way.back().tick < ticks) {
    const Vector3d away = kWandering * std::cbrt(source.uniform(0.0, 1.0)) * source.direction();
    const Eigen::AngleAxisd turn(source.uniform(-kLedTurn, kLedTurn), source.direction());
    const Isometry3d X_WG = bench::pose(turn * X_WV_start.linear(), X_WV_start.translation() + away);
    const Isometry3d& X_before = way.back().X_WG;
    const double length = (X_WG.translation() - X_before.translation()).norm();
    const double angle = Eigen::Quaterniond(X_before.linear()).angularDistance(Eigen::Quaterniond(X_WG.linear()));
    const double duration = std::max({1.0, length / kLedSpeed, angle / kLedAngularSpeed});
    way.push_back({way.back().tick + static_cast<int>(std::ceil(duration)), X_WG});
  }
  return way;
}

Isometry3d beside(PoseSource& source) {
  for (int tries = 0; tries < 100; ++tries) {
    const Eigen::Matrix3d R_AB = source.rotation();
    const Vector3d axis = source.direction();
    if (const std::optional<double> distance = source.approach(R_AB, axis, kGap))
      return bench::pose(R_AB, *distance * axis);
  }
  throw std::invalid_argument("two meshes come nowhere as near as a millimetre");
}

SlidingScene led(std::string name, const geometry::TriangleMesh& mesh_A, const geometry::TriangleMesh& mesh_B,
                 const std::optional<Isometry3d>& X_AB, int ticks) {
  SlidingScene scene;
  scene.name = std::move(name);
  scene.obstacles = {test_support::obstacle_of(mesh_A)};
  scene.part_V = test_support::part_of(mesh_B);
  PoseSource source(scene.obstacles.front().body->tree, scene.part_V->tree, kLedSeed);
  scene.X_WV_start = X_AB ? *X_AB : beside(source);
  scene.ghost = test_support::led_through(wander(scene.X_WV_start, ticks, source));
  scene.ticks = ticks;
  return scene;
}

SlidingScene led_pair(const std::string& name, const UserPair& pair, int ticks) {
  const geometry::TriangleMesh& mesh_A = *pair.mesh_A.mesh;
  const geometry::TriangleMesh& mesh_B = *pair.mesh_B.mesh;
  const double scale =
      pair.metres_per_unit.value_or(kExtent / std::max(largest_extent(mesh_A), largest_extent(mesh_B)));
  std::optional<Isometry3d> X_AB;  // of the centres
  if (pair.p_AB)
    X_AB = bench::pose(Eigen::Matrix3d::Identity(), scale * (*pair.p_AB + center_of(mesh_B) - center_of(mesh_A)));
  return led(name, centered(mesh_A, scale), centered(mesh_B, scale), X_AB, ticks);
}

void run_led(benchmark::State& state, const std::string& name, const UserPair& pair, int ticks) {
  SlidingScene scene;
  try {
    scene = led_pair(name, pair, ticks);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
  for (auto _ : state) {
    const PacedRun run = run_paced(kSlidingSubjects.front(), scene, ticks);
    run.report_times(state);
    state.counters["ticks"] = ticks;
    state.counters["triangles"] = static_cast<double>(scene.obstacles.front().body->tree.mesh().triangles.size() +
                                                      scene.part_V->tree.mesh().triangles.size());
    state.counters["pushed"] = static_cast<double>(run.times.count()) / ticks;
    state.counters["colliding_poses"] = count_collisions(scene, run.X_WV);
  }
}

}  // namespace

void register_led(const BenchOptions& options) {
  const std::vector<UserMesh> meshes = user_meshes(options.meshes);
  const auto add = [ticks = options.quick ? 300 : 2000](const std::string& name, const UserPair& pair) {
    register_single_run("led/" + name + "/" + kSlidingSubjects.front().name, [=](benchmark::State& state) {
      run_led(state, name, pair, ticks);
    })->UseManualTime();
  };
  for (const UserMesh& mesh : meshes)
    add(mesh.name, {mesh, mesh});
  if (options.pairs.empty()) return;
  for (const UserPair& pair : user_pairs(options.pairs, meshes))
    add(pair.mesh_A.name + "+" + pair.mesh_B.name, pair);
}

}  // namespace glissade::bench

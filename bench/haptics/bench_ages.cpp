// See `run_ages` in benches.h.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/haptics/multi_part_sliding.h>

#include "benches.h"
#include "held_part.h"
#include "poses.h"
#include "scripted_scene.h"
#include "sliding_account.h"

namespace glissade::bench {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pose;
using test_support::SlidingScene;
using test_support::turn;

constexpr double kMillisecond_s = 1e-3;
constexpr double kLongestCatchUp_ms = 250.0;  // as the server

/// Down by `depth` at `speed` (m/s), then to and fro along x, 15 mm to either side.
SlidingScene pressed_and_dragged(const std::string& name, haptics::Obstacle obstacle,
                                 std::shared_ptr<const haptics::SlidingPart> part_V, const Isometry3d& X_WV_start,
                                 double depth, double speed) {
  SlidingScene scene;
  scene.name = name;
  scene.obstacles.push_back(std::move(obstacle));
  scene.part_V = std::move(part_V);
  scene.X_WV_start = X_WV_start;
  scene.ticks = 5000;
  scene.ghost = [=](int tick) -> Isometry3d {
    constexpr double kAmplitude = 15e-3;
    const double way = speed * kMillisecond_s * tick;
    const double along = std::fmod(std::max(0.0, way - depth) + kAmplitude, 4.0 * kAmplitude);
    const double x = along < 2.0 * kAmplitude ? along - kAmplitude : 3.0 * kAmplitude - along;
    return pose({x, 0.0, -std::min(way, depth)}) * X_WV_start;
  };
  return scene;
}

/// A ball of 20 mm on one of 100 mm, 3 mm deep. The triangles of a ball meet at its poles: the axes lie across, unless
/// the balls are to meet at these poles, where every triangle of one is near every triangle of the other.
SlidingScene balls(const std::string& name, std::int64_t of_part, std::int64_t of_obstacle, double speed,
                   bool at_poles = false) {
  const Eigen::Quaterniond q = turn(at_poles ? 0.0 : 1.3, Vector3d(1.0, 0.4, 0.0).normalized());
  return pressed_and_dragged(
      name, test_support::obstacle_of(geometry::make_sphere(0.1, of_obstacle), pose(Vector3d::Zero(), q)),
      test_support::part_of(geometry::make_sphere(0.02, of_part)), pose({0.0, 0.0, 0.1205}, q), 3.5e-3, speed);
}

/// A ball in a hollow one with 0.1 mm of play, pressed against it and turned: thousands of triangles are near.
SlidingScene ball_in_socket(const std::string& name) {
  SlidingScene scene;
  scene.name = name;
  scene.obstacles.push_back(test_support::obstacle_of(geometry::make_sphere(0.0201, 100'000)));
  scene.part_V = test_support::part_of(geometry::make_sphere(0.02, 100'000));
  scene.ticks = 5000;
  scene.ghost = [](int tick) -> Isometry3d {
    const double t = kMillisecond_s * tick;
    return pose({2e-3 * std::sin(3.0 * t), 0.0, -std::min(0.1 * t, 3e-3)}, turn(std::sin(2.0 * t), Vector3d::UnitY()));
  };
  return scene;
}

AlignedBox3d bounds_of(const geometry::TriangleMesh& mesh) {
  AlignedBox3d box;
  for (const Vector3d& x : mesh.vertices)
    box.extend(x);
  return box;
}

geometry::TriangleMesh mesh_of_size(const std::string& folder, const char* file, double size) {
  const std::filesystem::path path = std::filesystem::path(folder) / std::filesystem::path(file).stem() / file;
  geometry::TriangleMesh mesh = geometry::import_mesh(path).mesh;
  const AlignedBox3d box = bounds_of(mesh);
  for (Vector3d& x : mesh.vertices)
    x = (x - box.center()) * (size / box.sizes().maxCoeff());
  return mesh;
}

/// Meshes of a folder, scaled to the sizes here (metres), the part 2 mm above the obstacle and then pressed into it.
SlidingScene of_meshes(const std::string& name, const std::string& folder, const char* part, double part_size,
                       const char* obstacle, double obstacle_size, double depth) {
  geometry::TriangleMesh mesh_V = mesh_of_size(folder, part, part_size);
  geometry::TriangleMesh mesh_O = mesh_of_size(folder, obstacle, obstacle_size);
  const double z = bounds_of(mesh_O).max().z() - bounds_of(mesh_V).min().z() + 2e-3;
  return pressed_and_dragged(name, test_support::obstacle_of(std::move(mesh_O)),
                             test_support::part_of(std::move(mesh_V)), pose({0.0, 0.0, z}), depth, 0.1);
}

struct Ages {
  std::vector<double> age_ms;   ///< of the ghost that the newest poses answer, each millisecond
  std::vector<double> call_ms;  ///< duration of each call
  double mean_lag_mm = 0.0;     ///< of the visible part behind the ghost, over all calls
  double early_share = 0.0;     ///< of the calls
};

/// Leads the part as the server's simulation thread does: the newest ghost at the beginning of each call, calls at
/// least a millisecond apart.
Ages ages_of(const SlidingScene& scene, const haptics::SlidingRules& rules, int ticks) {
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  haptics::MultiPartSliding sliding(scene.obstacles, {{.part_V = scene.part_V, .X_WV_start = scene.X_WV_start}}, rules);
  Ages ages;
  const Clock::time_point start = Clock::now();
  std::vector<double> begins{0.0};  // of the calls and so the times of their ghosts, ms
  double answered = 0.0;            // the ghost that the poses answer, ms
  double next_tick = 0.0;           // of the haptic thread, ms
  while (begins.back() < ticks) {
    const double begin = Milliseconds(Clock::now() - start).count();
    const Isometry3d X_WG = scene.ghost(static_cast<int>(begin));
    sliding.advance({&X_WG, 1}, std::min(begin - begins.back(), kLongestCatchUp_ms));
    begins.push_back(begin);
    const double end = Milliseconds(Clock::now() - start).count();
    for (; next_tick < end; next_tick += 1.0)
      ages.age_ms.push_back(next_tick - answered);
    answered = begins[static_cast<std::size_t>(sliding.answered_call())];
    ages.call_ms.push_back(end - begin);
    ages.mean_lag_mm += 1e3 * (X_WG.translation() - sliding.result(0).X_WV.translation()).norm();
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(Milliseconds(begin + 1.0)));
  }
  const auto calls = static_cast<double>(ages.call_ms.size());
  ages.mean_lag_mm /= calls;
  ages.early_share = static_cast<double>(sliding.call_statistics().ended_early) / calls;
  return ages;
}

void add_ages(const std::string& scene, const std::string& subject, const Ages& ages, Results& results) {
  const auto row = [&](const char* metric, double value, const char* unit) {
    results.add({kAges, scene, subject, metric, value, unit});
  };
  row("age_p50", quantile(ages.age_ms, 0.5), "ms");
  row("age_p99", quantile(ages.age_ms, 0.99), "ms");
  row("age_max", quantile(ages.age_ms, 1.0), "ms");
  row("call_p50", quantile(ages.call_ms, 0.5), "ms");
  row("call_p99", quantile(ages.call_ms, 0.99), "ms");
  row("call_max", quantile(ages.call_ms, 1.0), "ms");
  row("lag_mean", ages.mean_lag_mm, "mm");
  row("ended_early", 100.0 * ages.early_share, "%");
}

}  // namespace

void run_ages(const SlidingBenchOptions& options, Results& results) {
  // Made one by one, and only those that are wanted: their trees take seconds.
  std::vector<std::pair<std::string, std::function<SlidingScene(const std::string& name)>>> scenes{
      {"car-door", [](const auto& /*name*/) { return car_door_scene(0.1); }},
      {"balls-200k-on-100k-0.1-m/s", [](const auto& name) { return balls(name, 200'000, 100'000, 0.1); }},
      {"balls-20k-on-100k-0.5-m/s", [](const auto& name) { return balls(name, 20'000, 100'000, 0.5); }},
      {"poles-20k-on-100k-0.1-m/s", [](const auto& name) { return balls(name, 20'000, 100'000, 0.1, true); }},
      {"socket", [](const auto& name) { return ball_in_socket(name); }}};
  if (!options.meshes.empty()) {
    const auto add = [&](const std::string& scene, const char* part, double part_size, const char* obstacle,
                         double obstacle_size, double depth) {
      scenes.emplace_back(scene, [=, &options](const std::string& name) {
        return of_meshes(name, options.meshes, part, part_size, obstacle, obstacle_size, depth);
      });
    };
    add("koala on scallop", "koala.obj", 0.06, "scallop.ply", 0.4, 0.03);
    add("ycb_power_drill on drivaer_body", "ycb_power_drill.obj", 0.15, "drivaer_body.obj", 4.6, 0.01);
    add("industreal_gear_small on industreal_gear_base", "industreal_gear_small.obj", 0.022, "industreal_gear_base.obj",
        0.15, 0.02);
  }
  haptics::SlidingRules without = haptics::real_time_rules();
  without.work_budget.reset();
  const haptics::SlidingRules with = haptics::real_time_rules();
  for (const auto& [name, make] : scenes) {
    const std::vector<std::string>& wanted = options.scenes;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    std::fprintf(stderr, "ages %s\n", name.c_str());
    const SlidingScene scene = make(name);
    const int ticks = options.quick ? std::min(scene.ticks, 1000) : scene.ticks;
    add_ages(name, "without-budget", ages_of(scene, without, ticks), results);
    add_ages(name, "with-budget", ages_of(scene, with, ticks), results);
  }
}

}  // namespace glissade::bench

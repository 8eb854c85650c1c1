// See `register_ages` in benches.h.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/geometry/mesh_generators.h>

#include "benches.h"
#include "call_times.h"
#include "held_part.h"
#include "poses.h"
#include "scripted_scene.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pose;
using test_support::SlidingScene;
using test_support::turn;

constexpr double kMillisecond_s = 1e-3;
constexpr double kLongestCatchUp_ms = 250.0;  // as the server

/// Down by `depth` at `speed` (m/s), then to and fro along x, 15 mm to either side.
SlidingScene pressed_and_dragged(const std::string& name, contact::Obstacle obstacle,
                                 std::shared_ptr<const contact::SlidingPart> part_V, const Isometry3d& X_WV_start,
                                 double depth, double speed) {
  SlidingScene scene;
  scene.name = name;
  scene.obstacles.push_back(std::move(obstacle));
  scene.part_V = std::move(part_V);
  scene.X_WV_start = X_WV_start;
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
  scene.ghost = [](int tick) -> Isometry3d {
    const double t = kMillisecond_s * tick;
    return pose({2e-3 * std::sin(3.0 * t), 0.0, -std::min(0.1 * t, 3e-3)}, turn(std::sin(2.0 * t), Vector3d::UnitY()));
  };
  return scene;
}

/// Leads the part as the server's simulation thread does: the newest ghost at the beginning of each call, calls at
/// least a millisecond apart.
void lead_in_real_time(benchmark::State& state, const SlidingScene& scene, const contact::SlidingRules& rules,
                       int ticks) {
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  contact::MultiPartSliding sliding(scene.obstacles, {{.part_V = scene.part_V, .X_WV_start = scene.X_WV_start}}, rules);
  CallTimes ages;  // of the ghost that the newest poses answer, each millisecond
  CallTimes calls;
  double lag_sum_mm = 0.0;  // of the visible part behind the ghost
  const Clock::time_point start = Clock::now();
  std::vector<double> begins{0.0};  // of the calls and so the times of their ghosts, ms
  double answered = 0.0;            // the ghost that the poses answer, ms
  double next_tick = 0.0;           // of the haptic thread, ms
  while (begins.back() < ticks) {
    const double begin = Milliseconds(Clock::now() - start).count();
    const Isometry3d X_WG = scene.ghost(static_cast<int>(begin));
    calls.measure([&] { sliding.advance({&X_WG, 1}, std::min(begin - begins.back(), kLongestCatchUp_ms)); });
    begins.push_back(begin);
    const double end = Milliseconds(Clock::now() - start).count();
    for (; next_tick < end; next_tick += 1.0)
      ages.record(std::chrono::duration_cast<std::chrono::nanoseconds>(Milliseconds(next_tick - answered)));
    answered = begins[static_cast<std::size_t>(sliding.answered_call())];
    lag_sum_mm += 1e3 * (X_WG.translation() - sliding.result(0).X_WV.translation()).norm();
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(Milliseconds(begin + 1.0)));
  }
  const auto count = static_cast<double>(calls.count());
  calls.report_tick(state);
  calls.report_ms(state, "call_");
  ages.report_ms(state, "age_");
  state.counters["lag_mean_mm"] = lag_sum_mm / count;
  state.counters["ended_early_percent"] = 100.0 * static_cast<double>(sliding.call_statistics().ended_early) / count;
}

}  // namespace

void register_ages(const BenchOptions& options) {
  contact::SlidingRules without_budget = contact::real_time_rules();
  without_budget.work_budget.reset();
  const auto add = [&](const std::string& name, const std::function<SlidingScene(const std::string& name)>& make) {
    const auto scene = lazy([=] { return make(name); });
    for (const auto& [subject, rules] :
         {std::pair("without-budget", without_budget), std::pair("with-budget", contact::real_time_rules())}) {
      const auto run = [=, rules = rules, ticks = options.quick ? 1000 : 2000](benchmark::State& state) {
        for (auto _ : state)
          lead_in_real_time(state, **scene, rules, ticks);
      };
      register_run("ages/" + name + "/" + subject, run)->UseManualTime();
    }
  };
  add("car-door", [](const auto& /*name*/) { return car_door_scene(0.1); });
  add("balls-200k-on-100k-0.1mps", [](const auto& name) { return balls(name, 200'000, 100'000, 0.1); });
  add("balls-20k-on-100k-0.5mps", [](const auto& name) { return balls(name, 20'000, 100'000, 0.5); });
  add("poles-20k-on-100k-0.1mps", [](const auto& name) { return balls(name, 20'000, 100'000, 0.1, true); });
  add("socket", [](const auto& name) { return ball_in_socket(name); });
}

}  // namespace glissade::bench

// See `register_old_sets` in benches.h.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/geometry/mesh_generators.h>

#include "benches.h"
#include "held_part.h"
#include "loop/contact_set_maker.h"
#include "one_hand_force.h"
#include "poses.h"
#include "scripted_scene.h"
#include "sweeps/sliding_scenes.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using haptics::ContactSet;
using std::chrono::milliseconds;
using test_support::pose;
using test_support::SlidingScene;
using test_support::turn;

constexpr double kTick_s = 1e-3;
constexpr double kUnlimited = 1e9;  // N: the limit of a device is not in the table
constexpr double kSpeed = 0.2;      // of the hand, m/s
constexpr const char* kFastPlane = "fast-plane";
constexpr int kSettling = 400;  // ticks in which the hand comes down; not counted

/// Goes to and fro between −amplitude and amplitude at `speed`, beginning at 0.
double to_and_fro(int tick, double amplitude, double speed = kSpeed) {
  const double way = std::fmod(speed * kTick_s * std::max(0, tick - kSettling) + amplitude, 4.0 * amplitude);
  return way < 2.0 * amplitude ? way - amplitude : 3.0 * amplitude - way;
}

/// How far the hand presses: 3 mm, and a tremor of 1 mm at 5 Hz. Begins 5 mm above.
double depth(int tick) {
  if (tick < kSettling) return -5e-3 + 8e-3 * tick / kSettling;
  return 3e-3 + 1e-3 * std::sin(2.0 * std::numbers::pi * 5.0 * kTick_s * (tick - kSettling));
}

constexpr int kTicks = 2400;

SlidingScene pressed_on_planes(const SlidingScene& scene, const Vector3d& seat, const Eigen::Quaterniond& q,
                               std::function<Vector3d(int)> along) {
  SlidingScene result = scene;
  result.ticks = kTicks;
  result.ghost = [=](int tick) { return pose(seat + along(tick) - Vector3d(0.0, 0.0, depth(tick)), q); };
  result.X_WV_start = result.ghost(0);
  return result;
}

SlidingScene pressed_plane(double speed) {
  const auto along = [speed](int tick) { return Vector3d(to_and_fro(tick, 0.1, speed), 0.0, 0.0); };
  return pressed_on_planes(test_support::plane_scene({1200, true}), {0.0, 0.0, 0.02}, turn(0.0, Vector3d::UnitZ()),
                           along);
}

SlidingScene pressed_groove() {
  const SlidingScene scene = test_support::groove_scene({1200, true});
  const Isometry3d X_WV = scene.ghost(1000);  // 3 mm deep
  const auto along = [](int tick) { return Vector3d(0.0, to_and_fro(tick, 0.1), 0.0); };
  return pressed_on_planes(scene, {X_WV.translation().x(), 0.0, X_WV.translation().z() + 3e-3},
                           Eigen::Quaterniond(X_WV.linear()), along);
}

/// Along the floor into the corner, 3 mm too far, and out of it again.
SlidingScene pressed_corner() {
  const auto along = [](int tick) {
    const double out = 0.05 + to_and_fro(tick, 0.053);
    return Vector3d(out, out, 0.0);
  };
  return pressed_on_planes(test_support::corner_scene({1200, true}), 0.5 * test_support::kBoxSize,
                           turn(0.0, Vector3d::UnitZ()), along);
}

/// A ball of 20 mm over one of 100 mm.
SlidingScene pressed_sphere() {
  SlidingScene scene;
  scene.name = "sphere";
  scene.obstacles.push_back(test_support::obstacle_of(geometry::make_sphere(0.1, 20'000)));
  scene.part_V = test_support::part_of(geometry::make_sphere(0.02, 2000));
  scene.ticks = kTicks;
  scene.ghost = [](int tick) {
    const double angle = to_and_fro(tick, 0.1) / 0.12;
    return pose((0.12 - depth(tick)) * Vector3d(std::sin(angle), 0.0, std::cos(angle)));
  };
  scene.X_WV_start = scene.ghost(0);
  return scene;
}

constexpr int kSlower = 10;
constexpr std::array kAges{0, 1, 5, 20, 50};  // of the sets, ms

/// The simulation's answers to all ghosts of a scene, with the force of each, and the force that is right: that of a
/// part which another simulation has led ten times as slowly, so that it is near its rest.
struct Answers {
  std::vector<Isometry3d> X_WG;
  std::vector<ContactSet> sets;
  std::vector<Vector3d> forces;
  std::vector<Vector3d> exact;
};

/// The scene's part, in the hand.
contact::MultiPartSliding held(const SlidingScene& scene, const contact::SlidingRules& rules) {
  return {scene.obstacles, {{.part_V = scene.part_V, .X_WV_start = scene.X_WV_start}}, rules};
}

Vector3d force_of(const contact::MultiPartSliding& sliding) {
  return contact::spring_wrench(sliding.stiffness(0), sliding.lag(0)).f;
}

Answers answers_of(const SlidingScene& scene, int ticks) {
  contact::MultiPartSliding slow = held(scene, {});
  contact::MultiPartSliding sliding = held(scene, {.contacts_ahead_ms = contact::real_time_rules().contacts_ahead_ms});
  Answers answers;
  std::vector<haptics::UrgentContact> scratch;
  for (int tick = 0; tick < ticks; ++tick) {
    answers.X_WG.push_back(scene.ghost(tick));
    sliding.advance({&answers.X_WG.back(), 1});
    answers.sets.push_back(make_contact_set(sliding, tick + 1, milliseconds(tick), scratch));
    answers.forces.push_back(force_of(sliding));
    const Isometry3d X_WG_last = scene.ghost(std::max(0, tick - 1));
    for (int step = 1; step <= kSlower; ++step) {
      const Isometry3d X_WG =
          test_support::between(X_WG_last, answers.X_WG.back(), static_cast<double>(step) / kSlower);
      slow.advance({&X_WG, 1});
    }
    answers.exact.push_back(force_of(slow));
  }
  return answers;
}

/// A spring of 1 N/m at each contact of the set that the ghost violates.
Vector3d unit_penalty(const ContactSet& set, const Isometry3d& X_WG, const contact::SlidingPart& part) {
  const geometry::Displacement d =
      geometry::displacement_between(set.parts[0].X_WV_of_rows, X_WG * set.parts[0].X_GT, part.p_Vref());
  Vector3d sum = Vector3d::Zero();
  for (const haptics::ContactRow& row : set.rows()) {
    const double violation = row.bound - row.velocity({&d, 1});
    if (violation > 0.0) sum += violation * row.n;
  }
  return sum;
}

/// The stiffness of these springs with which the force of new sets fits the scene best, N/m.
double best_penalty_stiffness(const Answers& answers, const contact::SlidingPart& part) {
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < answers.sets.size(); ++i) {
    const Vector3d unit = unit_penalty(answers.sets[i], answers.X_WG[i], part);
    products += unit.dot(answers.exact[i]);
    squares += unit.squaredNorm();
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/// What the subjects of a scene share.
struct OldSets {
  SlidingScene scene;
  Answers answers;
  double peak_N;
  double penalty_stiffness;
};

OldSets old_sets_of(SlidingScene scene, bool quick) {
  Answers answers = answers_of(scene, std::min(scene.ticks, quick ? kSettling + 400 : scene.ticks));
  double peak = 0.0;
  for (const Vector3d& force : answers.exact)
    peak = std::max(peak, force.norm());
  const double stiffness = best_penalty_stiffness(answers, *scene.part_V);
  return {std::move(scene), std::move(answers), peak, stiffness};
}

/// The force at each tick with the set of the tick `then`. Is asked for ticks in their order.
using ForceAt = std::function<Vector3d(std::size_t tick, std::size_t then)>;

ForceAt our_force(const OldSets& sets, int age) {
  const contact::SlidingPart& part = *sets.scene.part_V;
  auto contacts = std::make_shared<test_support::OneHandForce>(
      part.p_Vref(), part.radius(), contact::stiffness_of_part(part.radius()), kUnlimited, sets.scene.X_WV_start);
  return [&sets, age, contacts](std::size_t tick, std::size_t then) {
    return contacts->update(sets.answers.sets[then], milliseconds(age), sets.answers.X_WG[tick], kTick_s).f;
  };
}

ForceAt last_force(const OldSets& sets, int /*age*/) {
  return [&sets](std::size_t /*tick*/, std::size_t then) { return sets.answers.forces[then]; };
}

ForceAt penalty_force(const OldSets& sets, int /*age*/) {
  return [&sets](std::size_t tick, std::size_t then) -> Vector3d {
    return sets.penalty_stiffness * unit_penalty(sets.answers.sets[then], sets.answers.X_WG[tick], *sets.scene.part_V);
  };
}

void run_with_old_sets(benchmark::State& state, const OldSets& sets, int age, const ForceAt& force_at, bool on_plane) {
  double greatest = 0.0;
  double sum_of_squares = 0.0;
  double sideways = 0.0;
  const std::size_t ticks = sets.answers.sets.size();
  for (auto _ : state) {
    for (auto tick = static_cast<std::size_t>(age); tick < ticks; ++tick) {
      const Vector3d force = force_at(tick, tick - static_cast<std::size_t>(age));
      const double error = (force - sets.answers.exact[tick]).norm();
      greatest = std::max(greatest, error);
      sum_of_squares += error * error;
      if (force.z() > 0.1) sideways = std::max(sideways, force.head<2>().norm() / force.z());
    }
  }
  const double mean_square = sum_of_squares / static_cast<double>(ticks - static_cast<std::size_t>(age));
  state.counters["peak_N"] = sets.peak_N;
  state.counters["error_max_percent"] = 100.0 * greatest / sets.peak_N;
  state.counters["error_rms_percent"] = 100.0 * std::sqrt(mean_square) / sets.peak_N;
  if (on_plane) state.counters["sideways_percent"] = 100.0 * sideways;
}

void register_scene(const std::string& name, bool quick, const std::function<SlidingScene()>& make) {
  const auto sets = lazy([=] { return old_sets_of(make(), quick); });
  const std::array<std::pair<const char*, ForceAt (*)(const OldSets&, int)>, 3> subjects{
      {{"glissade", our_force}, {"last-force", last_force}, {"penalty", penalty_force}}};
  const bool on_plane = name == kFastPlane;
  for (const int age : kAges) {
    for (const auto& [subject, make_force] : subjects) {
      register_single_run("tick/" + name + "-" + std::to_string(age) + "ms/" + subject,
                          [=, make_force = make_force](benchmark::State& state) {
                            run_with_old_sets(state, **sets, age, make_force(**sets, age), on_plane);
                          });
      if (on_plane) break;  // the others are compared at the usual speed
    }
  }
}

}  // namespace

void register_old_sets(const BenchOptions& options) {
  register_scene("plane", options.quick, [] { return pressed_plane(kSpeed); });
  register_scene(kFastPlane, options.quick, [] { return pressed_plane(0.5); });
  register_scene("groove", options.quick, pressed_groove);
  register_scene("corner", options.quick, pressed_corner);
  register_scene("sphere", options.quick, pressed_sphere);
  register_scene("car-door", options.quick, [] { return car_door_scene(kSpeed); });
}

}  // namespace glissade::bench

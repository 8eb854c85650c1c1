// See `run_tick` in benches.h.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/multi_part_sliding.h>

#include "benches.h"
#include "held_part.h"
#include "loop/contact_set_maker.h"
#include "one_hand_force.h"
#include "poses.h"
#include "scripted_scene.h"
#include "sliding_account.h"
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
constexpr double kFastSpeed = 0.5;  // for the force along the plane
constexpr int kSettling = 400;      // ticks in which the hand comes down; not counted

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

SlidingScene plane(double speed = kSpeed) {
  const auto along = [speed](int tick) { return Vector3d(to_and_fro(tick, 0.1, speed), 0.0, 0.0); };
  return pressed_on_planes(test_support::plane_scene({1200, true}), {0.0, 0.0, 0.02}, turn(0.0, Vector3d::UnitZ()),
                           along);
}

SlidingScene groove() {
  const SlidingScene scene = test_support::groove_scene({1200, true});
  const Isometry3d X_WV = scene.ghost(1000);  // 3 mm deep
  const auto along = [](int tick) { return Vector3d(0.0, to_and_fro(tick, 0.1), 0.0); };
  return pressed_on_planes(scene, {X_WV.translation().x(), 0.0, X_WV.translation().z() + 3e-3},
                           Eigen::Quaterniond(X_WV.linear()), along);
}

/// Along the floor into the corner, 3 mm too far, and out of it again.
SlidingScene corner() {
  const auto along = [](int tick) {
    const double out = 0.05 + to_and_fro(tick, 0.053);
    return Vector3d(out, out, 0.0);
  };
  return pressed_on_planes(test_support::corner_scene({1200, true}), 0.5 * test_support::kBoxSize,
                           turn(0.0, Vector3d::UnitZ()), along);
}

/// A ball of 20 mm over one of 100 mm.
SlidingScene sphere() {
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
haptics::MultiPartSliding held(const SlidingScene& scene, const haptics::SlidingRules& rules) {
  return {scene.obstacles, {{.part_V = scene.part_V, .X_WV_start = scene.X_WV_start}}, rules};
}

Vector3d force_of(const haptics::MultiPartSliding& sliding) {
  return haptics::spring_wrench(sliding.stiffness(0), sliding.error(0)).f;
}

Answers answers_of(const SlidingScene& scene, int ticks) {
  haptics::MultiPartSliding slow = held(scene, {});
  haptics::MultiPartSliding sliding = held(scene, {.contacts_ahead_ms = haptics::real_time_rules().contacts_ahead_ms});
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
Vector3d unit_penalty(const ContactSet& set, const Isometry3d& X_WG, const haptics::SlidingPart& part) {
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
double best_penalty_stiffness(const Answers& answers, const haptics::SlidingPart& part) {
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < answers.sets.size(); ++i) {
    const Vector3d unit = unit_penalty(answers.sets[i], answers.X_WG[i], part);
    products += unit.dot(answers.exact[i]);
    squares += unit.squaredNorm();
  }
  return squares > 0.0 ? products / squares : 0.0;
}

class Errors {
 public:
  void add(const Vector3d& force, const Vector3d& exact) {
    const double error = (force - exact).norm();
    greatest_ = std::max(greatest_, error);
    sum_of_squares_ += error * error;
    ++count_;
  }

  void report(const std::string& name, const std::string& subject, double peak, Results& results) const {
    results.add({kTick, name, subject, "error_max", 100.0 * greatest_ / peak, "%"});
    results.add({kTick, name, subject, "error_rms", 100.0 * std::sqrt(sum_of_squares_ / count_) / peak, "%"});
  }

 private:
  double greatest_ = 0.0;
  double sum_of_squares_ = 0.0;
  double count_ = 0.0;
};

void run_scene(const SlidingScene& scene, bool quick, Results& results) {
  std::fprintf(stderr, "tick %s\n", scene.name.c_str());
  const int ticks = std::min(scene.ticks, quick ? kSettling + 400 : scene.ticks);
  const Answers answers = answers_of(scene, ticks);
  double peak = 0.0;
  for (const Vector3d& force : answers.exact)
    peak = std::max(peak, force.norm());
  results.add({kTick, scene.name, "exact", "peak", peak, "N"});
  if (peak == 0.0) return;
  const haptics::CouplingStiffness stiffness = haptics::default_stiffness(scene.part_V->radius());
  const double penalty_stiffness = best_penalty_stiffness(answers, *scene.part_V);
  for (const int age : kAges) {
    test_support::OneHandForce contacts(scene.part_V->p_Vref(), scene.part_V->radius(), stiffness, kUnlimited,
                                        scene.X_WV_start);
    Errors ours;
    Errors held;
    Errors penalty;
    for (int tick = age; tick < ticks; ++tick) {
      const auto now = static_cast<std::size_t>(tick);
      const std::size_t then = now - static_cast<std::size_t>(age);
      const ContactSet& set = answers.sets[then];
      const Vector3d force = contacts.update(set, milliseconds(age), answers.X_WG[now], kTick_s).f;
      ours.add(force, answers.exact[now]);
      held.add(answers.forces[then], answers.exact[now]);
      penalty.add(penalty_stiffness * unit_penalty(set, answers.X_WG[now], *scene.part_V), answers.exact[now]);
    }
    const std::string name = scene.name + "-" + std::to_string(age) + "ms";
    ours.report(name, "glissade", peak, results);
    held.report(name, "last-force", peak, results);
    penalty.report(name, "penalty", peak, results);
  }
}

/// The greatest force along a plane, in percent of the force across it, with the hand at 0.5 m/s.
void run_sideways(bool quick, Results& results) {
  const SlidingScene scene = plane(kFastSpeed);
  const int ticks = std::min(scene.ticks, quick ? kSettling + 400 : scene.ticks);
  const Answers answers = answers_of(scene, ticks);
  for (const int age : kAges) {
    test_support::OneHandForce contacts(scene.part_V->p_Vref(), scene.part_V->radius(),
                                        haptics::default_stiffness(scene.part_V->radius()), kUnlimited,
                                        scene.X_WV_start);
    double sideways = 0.0;
    for (int tick = age; tick < ticks; ++tick) {
      const auto now = static_cast<std::size_t>(tick);
      const ContactSet& set = answers.sets[now - static_cast<std::size_t>(age)];
      const Vector3d force = contacts.update(set, milliseconds(age), answers.X_WG[now], kTick_s).f;
      if (force.z() > 0.1) sideways = std::max(sideways, force.head<2>().norm() / force.z());
    }
    results.add({kTick, "plane-" + std::to_string(age) + "ms", "glissade", "sideways", 100.0 * sideways, "%"});
  }
}

/// A set of `rows` contacts on the lower side of the part.
ContactSet random_set(int rows) {
  std::mt19937_64 random(static_cast<std::uint64_t>(rows));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  ContactSet set;
  set.sequence = 1;
  set.parts[0].hold = 1;
  set.row_count = rows;
  for (int i = 0; i < rows; ++i) {
    const Vector3d n = (0.5 * vector() + Vector3d::UnitZ()).normalized();
    set.row_array[static_cast<std::size_t>(i)] = {{{n, 0.05 * vector(), -1e-5 * (1.0 + uniform(random))}}};
  }
  return set;
}

/// Median of 101 means of the time of a thousand calls of `tick(i)`, µs: single calls are too short for the clock.
double median_us(const std::function<void(int)>& tick) {
  constexpr int kPass = 1000;
  std::vector<double> passes;
  for (int pass = 0; pass < 101; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kPass; ++i)
      tick(pass * kPass + i);
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
    passes.push_back(time.count() / kPass);
  }
  return quantile(passes, 0.5);
}

devices::GloveState state_at(int tick) {
  devices::GloveState state;
  state.sequence = tick;
  state.time = milliseconds(tick);
  const double phase = 0.01 * tick;
  state.X_WH.translation() = 1e-3 * Vector3d(std::sin(phase), std::cos(phase), -1.0 + 0.3 * std::sin(2.0 * phase));
  return state;
}

/// The time of a tick of two hands with a part each, which are in contact, among four parts: twelve rows, half of them
/// between the two.
double two_hands_us(const haptics::SlidingPart& part, const devices::DeviceDescriptor& device) {
  ContactSet set = random_set(12);
  set.part_count = 4;
  set.parts[1].hold = 1;
  for (std::size_t i = 0; i < 12; ++i) {
    haptics::ContactRow& row = set.row_array[i];
    row.part = i < 9 ? 0 : 1;
    if (i < 6) row.other = 1;
    row.r_other = row.r;
  }
  const haptics::KernelPart each{part.p_Vref(), part.radius(), haptics::default_stiffness(part.radius())};
  haptics::HapticKernel kernel({each, each, each, each}, {{device, 0}, {device, 1}});
  return median_us([&](int i) {
    set.time = milliseconds(i);
    const devices::GloveState first = state_at(i);
    const devices::GloveState second = state_at(i + 300);
    const std::array<const devices::GloveState*, 2> newest{&first, &second};
    kernel.tick(newest, set, milliseconds(i));
  });
}

void run_costs(Results& results) {
  std::fprintf(stderr, "tick costs\n");
  const auto part = test_support::part_of(geometry::make_box(test_support::kBoxSize, 12));
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  for (const int rows : {0, 12, 64}) {
    ContactSet set = random_set(rows);
    haptics::HapticKernel kernel({{part->p_Vref(), part->radius(), haptics::default_stiffness(part->radius())}},
                                 {{device, 0}});
    const double us = median_us([&](int i) {
      set.time = milliseconds(i);
      const devices::GloveState state = state_at(i);
      const devices::GloveState* const newest = &state;
      kernel.tick({&newest, 1}, set, milliseconds(i));
    });
    results.add({kTick, "cost-" + std::to_string(rows), "glissade", "time", us, "us"});
  }
  results.add({kTick, "cost-12-two-hands", "glissade", "time", two_hands_us(*part, device), "us"});
  devices::SafetyEnvelope envelope(device);
  const double us = median_us([&](int i) {
    devices::GloveCommand command;
    command.state_time = milliseconds(i);
    command.f_H_W.z() = 10.0;
    envelope.limit(command, state_at(i), milliseconds(i));
  });
  results.add({kTick, "cost-envelope", "glissade", "time", us, "us"});
}

}  // namespace

void run_tick(const SlidingBenchOptions& options, Results& results) {
  for (const SlidingScene& scene : {plane(), groove(), corner(), sphere(), car_door_scene(kSpeed)})
    run_scene(scene, options.quick, results);
  for (const std::string& path : options.scene_files)
    run_scene(scene_from_file(path, kSpeed), options.quick, results);
  run_sideways(options.quick, results);
  run_costs(results);
}

}  // namespace glissade::bench

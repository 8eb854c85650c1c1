/// The clasp of a hand round a ball of 16,000 triangles (`grasping::Clasp`), and two hands among a hundred objects
/// (`grasping::GraspSimulation`). Times are those of all threads on processors, because the search thread works for the
/// calls.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/shapes/household_objects.h>

#include "bench_program.h"
#include "call_times.h"
#include "clasped_hand.h"
#include "poses.h"
#include "wild_hand.h"

namespace glissade::bench {
namespace {

using grasping::Clasp;
using grasping::Posture;
using test_support::at;
using test_support::bent_hand;
using test_support::hand_chain;
using test_support::hand_model;
using test_support::open_hand;

constexpr double kRadius_m = 0.035;
constexpr double kFist = 1.2;  // rad
constexpr int kClosing_ms = 150;

/// A ball before the palm of the hand that has its root at the origin.
geometry::TriangleMesh ball() {
  return geometry::make_sphere(kRadius_m, 16'000);
}

Clasp clasp_of(geometry::TriangleMesh mesh, const Eigen::Isometry3d& X_WB) {
  auto shared = std::make_shared<const geometry::TriangleMesh>(std::move(mesh));
  const grasping::ClaspRules rules{.work_budget = grasping::work_of_hand(contact::real_time_rules())};
  Clasp clasp(hand_chain(), {}, {std::make_shared<const contact::SlidingPart>(std::move(shared))}, rules);
  clasp.place_object(0, X_WB);
  return clasp;
}

Clasp clasp_of_ball() {
  return clasp_of(ball(), at(0.095, 0.0, -0.056));
}

Posture closing(int ms) {
  return bent_hand(kFist * std::min(1.0, static_cast<double>(ms) / kClosing_ms));
}

/// A closed hand whose fingers press now more, now less, while the hand moves to and fro by 2 mm.
Posture pressing(int ms) {
  const double phase = 2.0 * std::numbers::pi * 2e-3 * ms;
  Posture posture = bent_hand(kFist + 0.1 * std::sin(phase));
  posture.X_WR = at(2e-3 * std::sin(0.7 * phase), 0.0, 2e-3 * (std::cos(0.7 * phase) - 1.0));
  return posture;
}

/// Time of all threads of the program on processors.
struct ProcessorClock {
  static std::chrono::nanoseconds now() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  }
};

template <typename Call>
void measure(CallTimes& times, const Call& call) {
  times.measure<ProcessorClock>(call);
}

/// Opens the hand, closes it, and passes each millisecond of that to `advance`.
void close(Clasp& clasp, const std::function<void(int ms)>& advance) {
  clasp.move_cart(open_hand());
  clasp.advance(open_hand());
  for (int ms = 1; ms <= kClosing_ms; ++ms)
    advance(ms);
}

/// The calls in which the hand closes: those before it touches the ball, or those after.
CallTimes closing_hand(int repeats, bool touches) {
  CallTimes times;
  Clasp clasp = clasp_of_ball();
  for (int i = 0; i < repeats; ++i) {
    close(clasp, [&](int ms) {
      const auto advance = [&] { clasp.advance(closing(ms)); };
      if (clasp.contacts().empty() == touches) {
        advance();
      } else {
        measure(times, advance);
      }
    });
  }
  return times;
}

CallTimes held_ball(int repeats) {
  CallTimes times;
  Clasp clasp = clasp_of_ball();
  for (int i = 0; i < repeats; ++i) {
    close(clasp, [&](int ms) { clasp.advance(closing(ms)); });
    for (int ms = 0; ms < 1000; ++ms)
      measure(times, [&] { clasp.advance(pressing(ms)); });
  }
  return times;
}

/// Every ten milliseconds, a clasp that knows nothing takes the posture of one that closes.
CallTimes clasp_from_scratch(int repeats) {
  CallTimes times;
  Clasp clasp = clasp_of_ball();
  Clasp afresh = clasp_of_ball();
  for (int i = 0; i < repeats; ++i) {
    close(clasp, [&](int ms) {
      if (ms % 10 == 0) {
        afresh.move_cart(clasp.posture());
        measure(times, [&] {
          afresh.advance(clasp.posture());
          afresh.advance(closing(ms));
        });
      }
      clasp.advance(closing(ms));
    });
  }
  return times;
}

CallTimes wild_hand(int repeats) {
  CallTimes times;
  const geometry::TriangleMesh mesh = ball();
  Clasp clasp = clasp_of(mesh, Eigen::Isometry3d::Identity());
  for (int i = 0; i < 2 * repeats; ++i) {
    const auto motion = static_cast<test_support::WildMotion>(i % test_support::kWildMotions);
    const test_support::WildHand hand(static_cast<std::uint64_t>(i + 1), motion, mesh);
    clasp.move_cart(hand.at_ms(0));
    clasp.advance(hand.at_ms(0));
    for (int ms = 1; ms <= test_support::WildHand::kMs; ++ms)
      measure(times, [&] { clasp.advance(hand.at_ms(ms)); });
  }
  return times;
}

/// A hand with an opposed thumb that closes round a ball before its palm: 0 is open, 1 is closed and presses.
Posture round_ball(double closed) {
  struct Value {
    std::string_view name;
    double open;  // rad
    double closed;
  };
  constexpr std::array kThumb{Value{"thumb_roll", 1.05, 1.0}, Value{"thumb_mcp", -0.17, 0.65},
                              Value{"thumb_ip", -0.26, 0.55}, Value{"thumb_index_abduction", 1.05, 0.4}};
  Posture posture = bent_hand(0.0);
  for (std::size_t v = 0; v < posture.values.size(); ++v) {
    const std::string_view name = hand_chain()->values()[v].name;
    const auto* const of_thumb =
        std::find_if(kThumb.begin(), kThumb.end(), [&](const Value& t) { return t.name == name; });
    if (of_thumb != kThumb.end()) {
      posture.values[v] = of_thumb->open + closed * (of_thumb->closed - of_thumb->open);
    } else if (name.ends_with("_mcp")) {
      posture.values[v] = -0.26 + closed * 1.4;
    } else if (name.ends_with("_pip")) {
      posture.values[v] = closed * 1.15;
    } else if (name.ends_with("_dip")) {
      posture.values[v] = -0.09 + closed * 0.85;
    }
  }
  return posture;
}

/// 98 things of a household on a shelf.
std::vector<contact::Obstacle> shelf() {
  constexpr std::size_t kThings = 98;
  constexpr double kEdge_m = 8e-3;
  std::vector<std::shared_ptr<const contact::ContactBody>> bodies;
  for (const shapes::HouseholdObject& kind : shapes::household_objects()) {
    bodies.push_back(std::make_shared<const contact::ContactBody>(
        std::make_shared<const geometry::TriangleMesh>(kind.make(kEdge_m))));
  }
  std::vector<contact::Obstacle> things;
  for (std::size_t i = 0; i < kThings; ++i) {
    const std::size_t row = i / 14;
    const double x = -1.5 + 0.25 * static_cast<double>(i % 14);
    things.push_back({bodies[i % bodies.size()], at(x, 0.35 + 0.3 * static_cast<double>(row), -0.1), "a thing"});
  }
  return things;
}

/// Two hands, each of which takes a ball from a shelf, carries it along the shelf, and puts it back. Whole calls of the
/// simulation; the counter `both_hold_percent` says in how many of them both hands hold a ball.
CallTimes hands_at_shelf(benchmark::State& state, int repeats) {
  constexpr double kApart_m = 0.5;
  const auto mesh = std::make_shared<const geometry::TriangleMesh>(ball());
  const auto part = std::make_shared<const contact::SlidingPart>(mesh);
  grasping::GraspSimulation simulation(shelf(),
                                       {{.part_V = part, .X_WV_start = at(0.095, 0.0, -0.058)},
                                        {.part_V = part, .X_WV_start = at(0.095 + kApart_m, 0.0, -0.058)}},
                                       {hand_model(), hand_model()}, {.sliding = contact::real_time_rules()});
  CallTimes times;
  int holding = 0;
  for (int i = 0; i < repeats; ++i) {
    for (int ms = 0; ms < 1000; ++ms) {
      const double closed = std::clamp(std::min(ms, 900 - ms) / 200.0, 0.0, 1.0);
      const double way = std::clamp(std::min(ms - 250, 700 - ms) / 200.0, 0.0, 1.0);
      std::array<std::optional<Posture>, 2> targets{round_ball(closed), round_ball(closed)};
      targets[0]->X_WR = at(0.0, 0.2 * way, 0.02 * way);
      targets[1]->X_WR = at(kApart_m, 0.2 * way, 0.02 * way);
      measure(times, [&] { simulation.advance(targets); });
      holding += simulation.held_part(0) && simulation.held_part(1) ? 1 : 0;
    }
  }
  state.counters["both_hold_percent"] = 0.1 * holding / repeats;
  return times;
}

/// A benchmark whose iteration is a run of one of the functions above.
void register_calls(const std::string& name, const std::function<CallTimes(benchmark::State&)>& run) {
  const auto run_once = [=](benchmark::State& state) {
    for (auto _ : state) {
      const CallTimes times = run(state);
      times.report_tick(state);
      times.report_ms(state);
      state.counters["calls"] = static_cast<double>(times.count());
    }
  };
  benchmark::RegisterBenchmark(("clasp/" + name + "/glissade").c_str(), run_once)
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void register_clasp(const BenchOptions& options) {
  const int repeats = options.quick ? 4 : 10;
  register_calls("free", [=](auto& /*state*/) { return closing_hand(repeats, false); });
  register_calls("closing", [=](auto& /*state*/) { return closing_hand(repeats, true); });
  register_calls("held", [=](auto& /*state*/) { return held_ball(repeats); });
  register_calls("from-scratch", [=](auto& /*state*/) { return clasp_from_scratch(repeats); });
  register_calls("wild", [=](auto& /*state*/) { return wild_hand(repeats); });
  register_calls("two-hands-100-objects", [=](auto& state) { return hands_at_shelf(state, repeats / 2); });
}

}  // namespace
}  // namespace glissade::bench

int main(int argc, char** argv) {
  return glissade::bench::run_bench_program(
      argc, argv,
      "Measure the clasp: a hand that closes round a ball, holds it, moves wildly; two hands among 100 objects",
      glissade::bench::register_clasp);
}

// See `run_clasp` in benches.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/shapes/household_objects.h>

#include "benches.h"
#include "clasped_hand.h"
#include "poses.h"
#include "sliding_account.h"
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
  const grasping::ClaspRules rules{.work_budget = grasping::work_of_hand(haptics::real_time_rules())};
  Clasp clasp(hand_chain(), {}, {std::make_shared<const haptics::SlidingPart>(std::move(shared))}, rules);
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

/// Of all threads on processors: the search thread works for the calls.
double now_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

class Times {
 public:
  template <typename Call>
  void measure(const Call& call) {
    const double start = now_ms();
    call();
    ms_.push_back(now_ms() - start);
  }
  void report(const std::string& name, Results& results) const {
    results.add({kClasp, name, "glissade", "calls", static_cast<double>(ms_.size()), "1"});
    results.add({kClasp, name, "glissade", "call_p50", quantile(ms_, 0.5), "ms"});
    results.add({kClasp, name, "glissade", "call_p99", quantile(ms_, 0.99), "ms"});
    results.add({kClasp, name, "glissade", "call_max", quantile(ms_, 1.0), "ms"});
  }

 private:
  std::vector<double> ms_;
};

void run_one_hand(int repeats, Results& results) {
  Times free_hand;
  Times closing_hand;
  Times held;
  Times from_scratch;
  Clasp clasp = clasp_of_ball();
  Clasp afresh = clasp_of_ball();
  for (int i = 0; i < repeats; ++i) {
    clasp.move_cart(open_hand());
    clasp.advance(open_hand());
    for (int ms = 1; ms <= kClosing_ms; ++ms) {
      const bool is_first = ms % 10 == 0;
      if (is_first) {
        afresh.move_cart(clasp.posture());
        from_scratch.measure([&] {
          afresh.advance(clasp.posture());
          afresh.advance(closing(ms));
        });
      }
      Times& times = clasp.contacts().empty() ? free_hand : closing_hand;
      times.measure([&] { clasp.advance(closing(ms)); });
    }
    for (int ms = 0; ms < 1000; ++ms)
      held.measure([&] { clasp.advance(pressing(ms)); });
  }
  free_hand.report("free", results);
  closing_hand.report("closing", results);
  held.report("held", results);
  from_scratch.report("from-scratch", results);
}

void run_wild_hand(int repeats, Results& results) {
  Times wild;
  const geometry::TriangleMesh mesh = ball();
  Clasp clasp = clasp_of(mesh, Eigen::Isometry3d::Identity());
  for (int i = 0; i < repeats; ++i) {
    const auto motion = static_cast<test_support::WildMotion>(i % test_support::kWildMotions);
    const test_support::WildHand hand(static_cast<std::uint64_t>(i + 1), motion, mesh);
    clasp.move_cart(hand.at_ms(0));
    clasp.advance(hand.at_ms(0));
    for (int ms = 1; ms <= test_support::WildHand::kMs; ++ms)
      wild.measure([&] { clasp.advance(hand.at_ms(ms)); });
  }
  wild.report("wild", results);
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

/// Two hands, each of which takes a ball of 16,000 triangles from a shelf of things of a household, carries it along
/// the shelf, and puts it back.
void run_shelf(int repeats, Results& results) {
  constexpr std::size_t kThings = 98;
  constexpr double kEdge_m = 8e-3;
  std::vector<haptics::Obstacle> things;
  const auto& kinds = shapes::household_objects();
  std::vector<std::shared_ptr<const haptics::ContactBody>> bodies;
  for (const shapes::HouseholdObject& kind : kinds)
    bodies.push_back(std::make_shared<const haptics::ContactBody>(
        std::make_shared<const geometry::TriangleMesh>(kind.make(kEdge_m))));
  for (std::size_t i = 0; i < kThings; ++i) {
    const std::size_t column = i % 14;
    const std::size_t row = i / 14;
    const Eigen::Isometry3d X_WO =
        at(-1.5 + 0.25 * static_cast<double>(column), 0.35 + 0.3 * static_cast<double>(row), -0.1);
    things.push_back({bodies[i % bodies.size()], X_WO, "a thing"});
  }
  const auto mesh = std::make_shared<const geometry::TriangleMesh>(ball());
  const auto part = std::make_shared<const haptics::SlidingPart>(mesh);
  const double apart = 0.5;
  grasping::GraspSimulation simulation(things,
                                       {{.part_V = part, .X_WV_start = at(0.095, 0.0, -0.058)},
                                        {.part_V = part, .X_WV_start = at(0.095 + apart, 0.0, -0.058)}},
                                       {hand_model(), hand_model()}, {.sliding = haptics::real_time_rules()});
  Times times;
  int holding = 0;
  for (int i = 0; i < repeats; ++i) {
    for (int ms = 0; ms < 1000; ++ms) {
      const double closed = std::clamp(std::min(ms, 900 - ms) / 200.0, 0.0, 1.0);
      const double way = std::clamp(std::min(ms - 250, 700 - ms) / 200.0, 0.0, 1.0);
      std::array<std::optional<Posture>, 2> targets{round_ball(closed), round_ball(closed)};
      targets[0]->X_WR = at(0.0, 0.2 * way, 0.02 * way);
      targets[1]->X_WR = at(apart, 0.2 * way, 0.02 * way);
      times.measure([&] { simulation.advance(targets); });
      holding += simulation.held_part(0) && simulation.held_part(1) ? 1 : 0;
    }
  }
  times.report("two-hands-100-objects", results);
  results.add({kClasp, "two-hands-100-objects", "glissade", "both_hold", 0.1 * holding / repeats, "%"});
}

}  // namespace

void run_clasp(const SlidingBenchOptions& options, Results& results) {
  const int repeats = options.quick ? 4 : 20;
  std::fprintf(stderr, "clasp of one hand\n");
  run_one_hand(repeats, results);
  std::fprintf(stderr, "clasp of a wild hand\n");
  run_wild_hand(2 * repeats, results);
  std::fprintf(stderr, "clasp of two hands\n");
  run_shelf(repeats / 2, results);
}

}  // namespace glissade::bench

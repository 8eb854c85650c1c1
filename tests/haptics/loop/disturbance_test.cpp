// What a hand gets while the simulation is held, its sets contradict each other, or the haptic loop misses its ticks:
// force and torque keep the limits and the slew, and return by themselves to those of an undisturbed run. So do the
// half-spaces and limits that a device holds by itself: they tighten no faster, and none of them stays.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pressed_finger.h"
#include "rubbed_box.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kBegin = milliseconds(2000);  // of the disturbance: the hand moves steadily by then
constexpr nanoseconds kEnd = milliseconds(9000);    // of the run

/// What the command is.
enum class Takes { kWrench, kHalfSpaces, kJointLimits };

/// What the hand feels: a force (N) and a torque (Nm), or the torque of the finger's joint (Nm) as `t`.
struct Felt {
  Vector3d f = Vector3d::Zero();
  Vector3d t = Vector3d::Zero();
};

Felt felt_of(const devices::GloveCommand& command, const devices::GloveState& state) {
  const devices::HandWrench held = devices::half_space_wrench(command.half_spaces, state.X_WH);
  const devices::JointLimit& limit = command.joint_limits.joints[PressedFinger::kJoint];
  const double of_finger = devices::limit_torque(limit, state.joint_angles[PressedFinger::kJoint], 0.0);
  return {command.f_H_W + held.f_H_W, command.t_H_W + held.t_H_W + Vector3d(of_finger, 0.0, 0.0)};
}

std::unique_ptr<DisturbedWorld> world_of(Takes takes) {
  if (takes == Takes::kJointLimits) return std::make_unique<PressedFinger>();
  return takes == Takes::kWrench ? std::make_unique<RubbedBox>() : std::make_unique<RubbedBox>(holding_arm());
}

/// Sees one command after the other, and the hand where it was in between.
class FeltLimits {
 public:
  explicit FeltLimits(Takes takes) : takes_(takes) {}

  /// From then on, and until then, what acts may not tighten.
  void expect_no_tightening(nanoseconds from, nanoseconds until) {
    old_from_ = from;
    old_until_ = until;
  }

  void see(nanoseconds now, const devices::GloveCommand& command, const devices::GloveState& state) {
    static const devices::DeviceDescriptor kDevice = devices::simulated_glove_descriptor();
    const double max_torque = takes_ == Takes::kJointLimits ? kDevice.max_joint_torque : kDevice.max_torque;
    constexpr double kSlack = 1.0 + 1e-9;
    const double seconds =
        std::chrono::duration<double>(std::min<nanoseconds>(now - last_time_, milliseconds(2))).count();
    const double slew =
        seconds * 1e3 / (takes_ == Takes::kJointLimits ? 2.0 : 7.0);  // periods from zero to the maximum
    const Felt felt = felt_of(command, state);
    // What the last command would exert now: a constraint that stands still changes nothing. After so long a time, the
    // device has dropped what it holds.
    if (now - last_time_ > last_.half_spaces.expiry) last_.half_spaces = {};
    if (now - last_time_ > last_.joint_limits.expiry) last_.joint_limits = {};
    const Felt before = felt_of(last_, state);
    const double change_f = (felt.f - before.f).norm();
    const bool opens = takes_ == Takes::kJointLimits && std::abs(felt.t.x()) < std::abs(before.t.x());
    const double change_t = opens ? 0.0 : (felt.t - before.t).norm();
    EXPECT_LE(felt.f.norm(), kSlack * kDevice.max_force) << "at " << now.count() << " ns";
    EXPECT_LE(felt.t.norm(), kSlack * max_torque) << "at " << now.count() << " ns";
    EXPECT_LE(change_f, kSlack * slew * kDevice.max_force) << "at " << now.count() << " ns";
    EXPECT_LE(change_t, kSlack * slew * max_torque) << "at " << now.count() << " ns";
    greatest_N = std::max(greatest_N, felt.f.norm());
    greatest_Nm = std::max(greatest_Nm, felt.t.norm());
    greatest_change_N = std::max(greatest_change_N, change_f);
    greatest_change_Nm = std::max(greatest_change_Nm, change_t);
    if (now > old_from_ && now <= old_until_) {
      EXPECT_LE(felt.f.norm(), before.f.norm() + 1e-9) << "tightens on an old set at " << now.count() << " ns";
      EXPECT_LE(felt.t.norm(), before.t.norm() + 1e-9) << "tightens on an old set at " << now.count() << " ns";
    }
    last_ = command;
    last_time_ = now;
  }

  double greatest_N = 0.0;
  double greatest_Nm = 0.0;
  double greatest_change_N = 0.0;  ///< from one command to the next
  double greatest_change_Nm = 0.0;

 private:
  Takes takes_;
  devices::GloveCommand last_;
  nanoseconds last_time_{0};
  nanoseconds old_from_{0};
  nanoseconds old_until_{0};
};

const DisturbedLoop::See kUnseen = [](nanoseconds, const devices::GloveCommand&, const devices::GloveState&) {};

/// What the hand gets, every millisecond.
const std::vector<Felt>& undisturbed_run(Takes takes) {
  static std::map<Takes, std::vector<Felt>> runs;
  std::vector<Felt>& run = runs[takes];
  if (!run.empty()) return run;
  const std::unique_ptr<DisturbedWorld> world = world_of(takes);
  DisturbedLoop(*world, {}).run(kEnd, kUnseen, [&](nanoseconds, const auto& command, const auto& state) {
    run.push_back(felt_of(command, state));
  });
  return run;
}

struct Outcome {
  FeltLimits hand;
  bool is_at_rest = false;   ///< no force, limit or half-space acts when the disturbance ends
  milliseconds recovery{0};  ///< from then until force and torque stay within 5 % of those of an undisturbed run
  double unrest = 0.0;       ///< greatest difference to that run in the last second, as a share of the force or torque
  std::uint64_t skipped_deadlines = 0;
};

/// A run with a failure from kBegin to `end`.
Outcome disturbed_run(Takes takes, const Failure& failure, nanoseconds end) {
  Outcome outcome{.hand = FeltLimits(takes)};
  // A wrench follows the hand on an old set, too.
  if (failure.holds_simulation && takes != Takes::kWrench) outcome.hand.expect_no_tightening(kBegin + kFullForce, end);
  FeltLimits server(takes);
  const std::unique_ptr<DisturbedWorld> world = world_of(takes);
  DisturbedLoop loop(*world, failure);
  auto expected = undisturbed_run(takes).begin();
  const auto see_hand = [&](nanoseconds now, const devices::GloveCommand& command, const devices::GloveState& state) {
    outcome.hand.see(now, command, state);
    const Felt felt = felt_of(command, state);
    const double off_N = (felt.f - expected->f).norm();
    const double off_Nm = (felt.t - expected->t).norm();
    const bool is_off = off_N > 0.05 * expected->f.norm() || off_Nm > 0.05 * expected->t.norm();
    if (now <= end) outcome.is_at_rest = command.is_at_rest();
    if (now > end && is_off) outcome.recovery = std::chrono::duration_cast<milliseconds>(now - end);
    if (now > kEnd - milliseconds(1000)) {
      outcome.unrest = std::max(
          outcome.unrest, takes == Takes::kJointLimits ? off_Nm / expected->t.norm() : off_N / expected->f.norm());
    }
    ++expected;
  };
  loop.run(
      kEnd, [&](nanoseconds now, const auto& command, const auto& state) { server.see(now, command, state); },
      see_hand);
  EXPECT_LT(outcome.unrest, 0.01) << "nothing oscillates afterwards";
  outcome.skipped_deadlines = loop.statistics().skipped_deadlines;
  return outcome;
}

/// A row of the tables in docs/safety.md.
void print(const std::string& name, const Outcome& outcome) {
  std::printf("| %s | %.1f N, %.2f Nm | %.2f N, %.3f Nm | %lld ms |\n", name.c_str(), outcome.hand.greatest_N,
              outcome.hand.greatest_Nm, outcome.hand.greatest_change_N, outcome.hand.greatest_change_Nm,
              static_cast<long long>(outcome.recovery.count()));
}

/// The force of the contacts changes more softly than the device would allow.
constexpr double kContactSlew_N = 1.0;

class Disturbance : public testing::TestWithParam<Takes> {};

TEST_P(Disturbance, ASimulationThatIsHeldLetsTheForceFadeAndGivesItBack) {
  const auto held_for = [](milliseconds time) {
    const nanoseconds end = kBegin + time;
    const Outcome outcome = disturbed_run(
        GetParam(), {.holds_simulation = [=](nanoseconds now) { return now >= kBegin && now < end; }}, end);
    print("simulation held for " + std::to_string(time.count()) + " ms", outcome);
    EXPECT_LT(outcome.hand.greatest_change_N, kContactSlew_N);
    EXPECT_LE(outcome.recovery, milliseconds(300));
    return outcome;
  };
  print("none", disturbed_run(GetParam(), {}, kBegin));
  EXPECT_EQ(held_for(milliseconds(10)).recovery, milliseconds(0)) << "the last set stands for the next";
  EXPECT_TRUE(held_for(milliseconds(100)).is_at_rest);
  EXPECT_TRUE(held_for(milliseconds(1000)).is_at_rest);
}

struct Contradiction {
  const char* name;
  std::function<void(bool is_odd_tick, std::mt19937_64& random, ContactSet& set)> corrupt;
};

/// Twelve rows around the part, each of which wants it 10 mm away, and a finger that must bend both ways.
void surround(ContactSet& set) {
  set.row_count = 12;
  for (std::size_t i = 0; i < 12; ++i) {
    const double angle = 0.5 * static_cast<double>(i);
    const Vector3d n = Vector3d(std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.5 : -0.5).normalized();
    set.row_array[i] = {{{n, -0.02 * n, 10e-3}}};
    set.row_array[i].pushes = true;
  }
  HandAnswer& hand = set.hands[0];
  hand.row_count = std::min(2, 2 * hand.row_count);
  hand.row_array[1] = hand.row_array[0];
  for (double& rate : hand.row_array[1].rates)
    rate = -rate;
}

void turn_normals(ContactSet& set) {
  for (ContactRow& row : set.row_array)
    row.n = -row.n;
  for (double& rate : set.hands[0].row_array[0].rates)
    rate = -rate;
}

void remove_rows(ContactSet& set) {
  set.row_count = 0;
  set.hands[0].row_count = 0;
}

void deepen_rows(ContactSet& set) {
  for (ContactRow& row : set.row_array)
    row.bound = 50e-3;
  set.hands[0].visible.angles[PressedFinger::kJoint] -= 50e-3 / PressedFinger::kArm_m;
}

void move_part(std::mt19937_64& random, ContactSet& set) {
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const Vector3d jump(uniform(random), uniform(random), uniform(random));
  set.parts[0].X_WV.translation() += jump;
  set.parts[0].X_WV_of_rows.translation() += jump;
  set.hands[0].visible.angles[PressedFinger::kJoint] += jump.z() / PressedFinger::kArm_m;
}

std::vector<Contradiction> contradictions() {
  using Random = std::mt19937_64;
  return {
      {"normals turn round every tick",
       [](bool is_odd, Random&, ContactSet& set) {
         if (is_odd) turn_normals(set);
       }},
      {"contacts vanish every other tick",
       [](bool is_odd, Random&, ContactSet& set) {
         if (is_odd) remove_rows(set);
       }},
      {"contacts 50 mm deep", [](bool, Random&, ContactSet& set) { deepen_rows(set); }},
      {"contacts 50 mm deep every other tick",
       [](bool is_odd, Random&, ContactSet& set) {
         if (is_odd) deepen_rows(set);
       }},
      {"12 rows without a solution", [](bool, Random&, ContactSet& set) { surround(set); }},
      {"12 rows without a solution every other tick",
       [](bool is_odd, Random&, ContactSet& set) {
         if (is_odd) surround(set);
       }},
      {"part jumps by up to 0.1 m every tick", [](bool, Random& random, ContactSet& set) { move_part(random, set); }},
  };
}

TEST_P(Disturbance, SetsThatContradictEachOtherForHalfASecondDoNotShakeTheHand) {
  const nanoseconds end = kBegin + milliseconds(500);
  for (const Contradiction& contradiction : contradictions()) {
    SCOPED_TRACE(contradiction.name);
    std::mt19937_64 random(1);
    const auto corrupt = [&](nanoseconds now, ContactSet& set) {
      if (now >= kBegin && now < end) contradiction.corrupt(now / kTickPeriod % 2 == 1, random, set);
    };
    const Outcome outcome = disturbed_run(GetParam(), {.corrupts = corrupt}, end);
    print(contradiction.name, outcome);
    // Half-spaces far outside the hand would store more energy than there is, so their force falls at the device's
    // rate.
    if (GetParam() == Takes::kWrench) EXPECT_LT(outcome.hand.greatest_change_N, kContactSlew_N);
    EXPECT_LE(outcome.recovery, milliseconds(2000)) << "a force that is reduced comes back softly";
  }
}

TEST_P(Disturbance, ATickThatTakesManyPeriodsLetsTheForceFadeAndGivesItBack) {
  for (const std::uint64_t periods : {2U, 10U, 100U, 1000U}) {
    SCOPED_TRACE(periods);
    const nanoseconds time = periods * kTickPeriod;
    const auto tick_time = [=](nanoseconds start) { return start == kBegin ? time : nanoseconds(0); };
    const Outcome outcome = disturbed_run(GetParam(), {.tick_time = tick_time}, kBegin + time);
    print("a tick takes " + std::to_string(periods) + " ms", outcome);
    EXPECT_EQ(outcome.skipped_deadlines, periods - 1);
    // A wrench of 7 N fades within 3 periods once its command is 6 periods old, and limits within 7.
    EXPECT_EQ(outcome.is_at_rest, periods >= (GetParam() == Takes::kWrench ? 10U : 100U));
    EXPECT_LE(outcome.recovery, milliseconds(300));
  }
}

// The coupling is softer while commands come late. A wrench gets back its stiffness as slowly as a link delay falls.
TEST_P(Disturbance, TicksThatAllTakeTooLongMakeTheContactSofterForAWhile) {
  for (const microseconds time : {microseconds(900), microseconds(1400), microseconds(3300), microseconds(12000)}) {
    SCOPED_TRACE(time.count());
    const nanoseconds end = kBegin + milliseconds(1000);
    const auto tick_time = [=](nanoseconds start) {
      return start >= kBegin && start < end ? nanoseconds(time) : nanoseconds(0);
    };
    const Outcome outcome = disturbed_run(GetParam(), {.tick_time = tick_time}, end);
    print("for 1 s, each tick takes " + std::to_string(time.count()) + " µs", outcome);
    EXPECT_EQ(outcome.recovery == milliseconds(0),
              time < (GetParam() == Takes::kWrench ? kTickPeriod : milliseconds(6)));
    EXPECT_LE(outcome.recovery, milliseconds(time == microseconds(3300) ? 1000 : 300));
  }
}

std::string name_of(Takes takes) {
  constexpr std::array<const char*, 3> kNames{"AWrench", "HalfSpaces", "JointLimits"};
  return kNames[static_cast<std::size_t>(takes)];
}

INSTANTIATE_TEST_SUITE_P(Of, Disturbance, testing::Values(Takes::kWrench, Takes::kHalfSpaces, Takes::kJointLimits),
                         [](const auto& takes) { return name_of(takes.param); });

}  // namespace
}  // namespace glissade::haptics

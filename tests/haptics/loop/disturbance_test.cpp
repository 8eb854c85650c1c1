// What a hand gets while the simulation is held, its sets contradict each other, or the haptic loop misses its ticks:
// force and torque keep the limits and the slew, and return by themselves to those of an undisturbed run.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rubbed_box.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kBegin = milliseconds(2000);  // of the disturbance: the hand moves steadily by then
constexpr nanoseconds kEnd = milliseconds(9000);    // of the run

/// Sees one command after the other.
class Limits {
 public:
  void see(const RubbedBox::Given& given) {
    static const devices::DeviceDescriptor kDevice = devices::simulated_glove_descriptor();
    constexpr double kSlack = 1.0 + 1e-9;
    constexpr double kSlew_per_s = 1.0 / 7e-3;  // from nothing to the maximum in seven periods
    constexpr nanoseconds kMostCounted = milliseconds(2);
    const nanoseconds passed = std::min<nanoseconds>(given.time - last_.time, kMostCounted);
    const double most = kSlack * kSlew_per_s * std::chrono::duration<double>(passed).count();
    const double change_f = (given.f - last_.f).norm();
    const double change_t = (given.t - last_.t).norm();
    EXPECT_LE(given.f.norm(), kSlack * kDevice.max_force) << "at " << given.time.count() << " ns";
    EXPECT_LE(given.t.norm(), kSlack * kDevice.max_torque) << "at " << given.time.count() << " ns";
    EXPECT_LE(change_f, most * kDevice.max_force) << "at " << given.time.count() << " ns";
    EXPECT_LE(change_t, most * kDevice.max_torque) << "at " << given.time.count() << " ns";
    greatest_N = std::max(greatest_N, given.f.norm());
    greatest_Nm = std::max(greatest_Nm, given.t.norm());
    greatest_change_N = std::max(greatest_change_N, change_f);
    greatest_change_Nm = std::max(greatest_change_Nm, change_t);
    last_ = given;
  }

  double greatest_N = 0.0;
  double greatest_Nm = 0.0;
  double greatest_change_N = 0.0;  ///< from one command to the next
  double greatest_change_Nm = 0.0;

 private:
  RubbedBox::Given last_;
};

/// What the hand gets, every millisecond.
std::vector<RubbedBox::Given> undisturbed_run() {
  std::vector<RubbedBox::Given> run;
  RubbedBox box({});
  box.run(
      kEnd, [](const RubbedBox::Given&) {}, [&](const RubbedBox::Given& given) { run.push_back(given); });
  return run;
}

struct Outcome {
  Limits hand;
  double force_at_end_N = 0.0;  ///< on the hand when the disturbance ends
  milliseconds recovery{0};     ///< from then until force and torque stay within 5 % of those of an undisturbed run
  double unrest_N = 0.0;        ///< greatest difference to that run in the last second
  std::uint64_t skipped_deadlines = 0;
};

/// A run with a disturbance from kBegin to `end`.
Outcome disturbed_run(const RubbedBox::Disturbance& disturbance, nanoseconds end) {
  static const std::vector<RubbedBox::Given> kUndisturbed = undisturbed_run();
  Outcome outcome;
  Limits server;
  RubbedBox box(disturbance);
  auto expected = kUndisturbed.begin();
  const auto see_hand = [&](const RubbedBox::Given& given) {
    outcome.hand.see(given);
    const double off_N = (given.f - expected->f).norm();
    const double off_Nm = (given.t - expected->t).norm();
    const bool is_off = off_N > 0.05 * expected->f.norm() || off_Nm > 0.05 * expected->t.norm();
    ++expected;
    if (given.time <= end) outcome.force_at_end_N = given.f.norm();
    if (given.time > end && is_off) outcome.recovery = std::chrono::duration_cast<milliseconds>(given.time - end);
    if (given.time > kEnd - milliseconds(1000)) outcome.unrest_N = std::max(outcome.unrest_N, off_N);
  };
  box.run(
      kEnd, [&](const RubbedBox::Given& given) { server.see(given); }, see_hand);
  EXPECT_LT(outcome.unrest_N, 0.05) << "nothing oscillates afterwards";
  outcome.skipped_deadlines = box.statistics().skipped_deadlines;
  return outcome;
}

/// A row of the table in docs/safety.md.
void print(const std::string& name, const Outcome& outcome) {
  std::printf("| %s | %.1f N, %.2f Nm | %.2f N, %.3f Nm | %lld ms |\n", name.c_str(), outcome.hand.greatest_N,
              outcome.hand.greatest_Nm, outcome.hand.greatest_change_N, outcome.hand.greatest_change_Nm,
              static_cast<long long>(outcome.recovery.count()));
}

bool is_at_rest(const Outcome& outcome) {
  return outcome.force_at_end_N == 0.0;
}

/// The force of the contacts changes more softly than the device would allow.
constexpr double kContactSlew_N = 1.0;

TEST(Disturbance, ASimulationThatIsHeldLetsTheForceFadeAndGivesItBack) {
  const auto held_for = [](milliseconds time) {
    const nanoseconds end = kBegin + time;
    const Outcome outcome =
        disturbed_run({.holds_simulation = [=](nanoseconds now) { return now >= kBegin && now < end; }}, end);
    print("simulation held for " + std::to_string(time.count()) + " ms", outcome);
    EXPECT_LT(outcome.hand.greatest_change_N, kContactSlew_N);
    EXPECT_LE(outcome.recovery, milliseconds(300));
    return outcome;
  };
  print("none", disturbed_run({}, kBegin));
  EXPECT_EQ(held_for(milliseconds(10)).recovery, milliseconds(0)) << "the last set stands for the next";
  EXPECT_TRUE(is_at_rest(held_for(milliseconds(100))));
  EXPECT_TRUE(is_at_rest(held_for(milliseconds(1000))));
}

struct Contradiction {
  const char* name;
  std::function<void(bool is_odd_tick, std::mt19937_64& random, ContactSet& set)> corrupt;
};

/// Twelve rows around the part, each of which wants it 10 mm away.
void surround(ContactSet& set) {
  set.row_count = 12;
  for (std::size_t i = 0; i < 12; ++i) {
    const double angle = 0.5 * static_cast<double>(i);
    const Vector3d n = Vector3d(std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.5 : -0.5).normalized();
    set.row_array[i] = {{{n, -0.02 * n, 10e-3}}};
    set.row_array[i].pushes = true;
  }
}

void turn_normals(ContactSet& set) {
  for (ContactRow& row : set.row_array)
    row.n = -row.n;
}

void deepen(ContactSet& set) {
  for (ContactRow& row : set.row_array)
    row.bound = 50e-3;
}

void move_part(std::mt19937_64& random, ContactSet& set) {
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const Vector3d jump(uniform(random), uniform(random), uniform(random));
  set.parts[0].X_WV.translation() += jump;
  set.parts[0].X_WV_of_rows.translation() += jump;
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
         if (is_odd) set.row_count = 0;
       }},
      {"contacts 50 mm deep", [](bool, Random&, ContactSet& set) { deepen(set); }},
      {"contacts 50 mm deep every other tick",
       [](bool is_odd, Random&, ContactSet& set) {
         if (is_odd) deepen(set);
       }},
      {"12 rows without a solution", [](bool, Random&, ContactSet& set) { surround(set); }},
      {"12 rows without a solution every other tick",
       [](bool is_odd, Random&, ContactSet& set) {
         if (is_odd) surround(set);
       }},
      {"part jumps by up to 0.1 m every tick", [](bool, Random& random, ContactSet& set) { move_part(random, set); }},
  };
}

TEST(Disturbance, SetsThatContradictEachOtherForHalfASecondDoNotShakeTheHand) {
  const nanoseconds end = kBegin + milliseconds(500);
  for (const Contradiction& contradiction : contradictions()) {
    SCOPED_TRACE(contradiction.name);
    std::mt19937_64 random(1);
    const auto corrupt = [&](nanoseconds now, ContactSet& set) {
      if (now >= kBegin && now < end) contradiction.corrupt(now / kTickPeriod % 2 == 1, random, set);
    };
    const Outcome outcome = disturbed_run({.corrupts = corrupt}, end);
    print(contradiction.name, outcome);
    EXPECT_LT(outcome.hand.greatest_change_N, kContactSlew_N);
    EXPECT_LE(outcome.recovery, milliseconds(2000)) << "a force that is reduced comes back softly";
  }
}

TEST(Disturbance, ATickThatTakesManyPeriodsLetsTheForceFadeAndGivesItBack) {
  for (const std::uint64_t periods : {2U, 10U, 100U, 1000U}) {
    SCOPED_TRACE(periods);
    const nanoseconds time = periods * kTickPeriod;
    const auto tick_time = [=](nanoseconds start) { return start == kBegin ? time : nanoseconds(0); };
    const Outcome outcome = disturbed_run({.tick_time = tick_time}, kBegin + time);
    print("a tick takes " + std::to_string(periods) + " ms", outcome);
    EXPECT_EQ(outcome.skipped_deadlines, periods - 1);
    EXPECT_EQ(is_at_rest(outcome), periods >= 10) << "7 N fade within 3 periods once their command is 6 periods old";
    EXPECT_LE(outcome.recovery, milliseconds(300));
  }
}

TEST(Disturbance, TicksThatAllTakeTooLongAreFeltWhenTheirCommandsAreOld) {
  for (const microseconds time : {microseconds(900), microseconds(1400), microseconds(3300), microseconds(12000)}) {
    SCOPED_TRACE(time.count());
    const nanoseconds end = kBegin + milliseconds(1000);
    const auto tick_time = [=](nanoseconds start) {
      return start >= kBegin && start < end ? nanoseconds(time) : nanoseconds(0);
    };
    const Outcome outcome = disturbed_run({.tick_time = tick_time}, end);
    print("for 1 s, each tick takes " + std::to_string(time.count()) + " µs", outcome);
    EXPECT_EQ(outcome.recovery == milliseconds(0), time < milliseconds(6));
    EXPECT_LE(outcome.recovery, milliseconds(300));
  }
}

}  // namespace
}  // namespace glissade::haptics

/// A hand that presses on a virtual wall: a half-space that the arm holds in its own loop, beside a force that comes
/// over a link of 60 Hz with 20 ms of delay.

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <utility>

#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove.h>

#include "glove_model/tool_loop.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;

constexpr double kAim_m = -5e-3;  // behind the wall
const SimulatedGloveParameters kWearer;

/// The wearer of the simulated glove along one axis, at 8 kHz.
struct PressingHand {
  GloveState state;

  void step(double force_N) {
    constexpr double kStep_s = 125e-6;
    double& z = state.X_WH.translation().z();
    double& v = state.v_WH.z();
    const double sum = kWearer.wearer_stiffness * (kAim_m - z) - (kWearer.wearer_damping + kWearer.arm_damping) * v;
    v += kStep_s / kWearer.mass * (sum + force_N);
    z += kStep_s * v;
    state.time += microseconds(125);
  }
};

struct RestOfHand {
  double swing_m = 0.0;  ///< from the least to the greatest depth in the last of ten seconds
  double z_m = 0.0;      ///< at the end
};

/// `force_N` has the force on the hand at each step.
RestOfHand pressed_for_ten_seconds(const std::function<double(const GloveState&)>& force_N) {
  PressingHand hand;
  hand.state.X_WH.translation().z() = 10e-3;
  double least = 1.0;
  double greatest = -1.0;
  for (int i = 0; i < 80'000; ++i) {
    hand.step(force_N(hand.state));
    if (i < 72'000) continue;
    least = std::min(least, hand.state.X_WH.translation().z());
    greatest = std::max(greatest, hand.state.X_WH.translation().z());
  }
  return {greatest - least, hand.state.X_WH.translation().z()};
}

HalfSpaces wall(double stiffness) {
  HalfSpaces half_spaces{.expiry = std::chrono::hours(1)};
  half_spaces.count = 1;
  half_spaces.rows[0].n_W = Vector3d::UnitZ();
  half_spaces.stiffness = stiffness;
  half_spaces.rotational_stiffness = 10.0;
  half_spaces.max_force = 100.0;
  return half_spaces;
}

/// An arm whose loop has 1 kHz and a delay of 1 ms.
RestOfHand held_by_arm(double stiffness) {
  ToolLoop loop({.loop_rate = 1000.0, .loop_delay = 1e-3}, {});
  return pressed_for_ten_seconds([&](const GloveState& hand) {
    return loop.advance(hand, wall(stiffness), std::chrono::nanoseconds(0)).f_H_W.z();
  });
}

RestOfHand forced_over_link(double stiffness) {
  constexpr int kPeriod = 133;  // steps of 125 µs
  constexpr int kDelay = 160;
  std::deque<std::pair<int, double>> on_their_way;
  double force = 0.0;
  int step = 0;
  return pressed_for_ten_seconds([&](const GloveState& hand) {
    if (step % kPeriod == 0)
      on_their_way.emplace_back(step + kDelay, stiffness * std::max(0.0, -hand.X_WH.translation().z()));
    while (!on_their_way.empty() && on_their_way.front().first <= step) {
      force = on_their_way.front().second;
      on_their_way.pop_front();
    }
    ++step;
    return force;
  });
}

// The hand swings from 1,505 N/m over the link, and from 25,200 N/m if the arm holds the half-space: 16.8 times. The
// lags of the two loops, 28.3 ms and 1.5 ms, have the ratio 19.
TEST(HeldHalfSpace, IsFifteenTimesAsStiffAsAForceOverASlowLink) {
  constexpr double kStiffness = 1600.0;  // N/m
  constexpr double kAtRest_m = 1e-6;
  EXPECT_GT(forced_over_link(kStiffness).swing_m, 100.0 * kAtRest_m) << "a limit cycle";
  EXPECT_LT(held_by_arm(15.0 * kStiffness).swing_m, kAtRest_m);
}

TEST(HeldHalfSpace, HandRestsWhereTheSpringsBalance) {
  for (const double stiffness : {500.0, 1000.0, 4000.0}) {
    const double balance = kWearer.wearer_stiffness * kAim_m / (kWearer.wearer_stiffness + stiffness);
    EXPECT_NEAR(held_by_arm(stiffness).z_m, balance, 0.01 * std::abs(balance)) << stiffness;
  }
}

TEST(HeldHalfSpace, IsDroppedWhenItExpiresAndReturnsSoftly) {
  ToolLoop loop({.loop_rate = 1000.0}, {});
  HalfSpaces half_spaces = wall(1000.0);
  half_spaces.expiry = std::chrono::milliseconds(10);
  GloveState hand;
  hand.X_WH.translation().z() = -10e-3;
  const auto force_after = [&](std::chrono::milliseconds age) {
    hand.time += std::chrono::milliseconds(1);
    return loop.advance(hand, half_spaces, age).f_H_W.z();
  };
  EXPECT_NEAR(force_after(std::chrono::milliseconds(10)), 10.0, 1e-12);
  EXPECT_EQ(force_after(std::chrono::milliseconds(11)), 0.0);
  double last = 0.0;
  for (int ms = 0; ms < 200; ++ms) {
    const double force = force_after(std::chrono::milliseconds(0));
    EXPECT_LE(force - last, 0.05 + 1e-12);
    last = force;
  }
  EXPECT_NEAR(last, 10.0, 1e-9);
}

}  // namespace
}  // namespace glissade::devices

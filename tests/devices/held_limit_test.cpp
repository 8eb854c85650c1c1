/// A finger that presses on a virtual wall: a limit that the device holds in its own loop, beside a torque that comes
/// over a link of 60 Hz with 20 ms of delay.

#include <algorithm>
#include <chrono>
#include <deque>
#include <utility>

#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>

#include "glove_model/finger_dynamics.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kPressed = 4;
constexpr double kWall_rad = 0.6;
constexpr double kAim_rad = 1.0;

hands::JointValues every_joint(double value) {
  hands::JointValues values{};
  values.fill(value);
  return values;
}

/// The servo glove of the presets, with a motor that no wall overloads. Its wearer has no tremor and no reflex, and
/// grips as a closed hand does.
GloveModel servo_glove(FingerKind kind) {
  GloveModel model = read_glove_model("dynamixel");
  model.fingers = kind;
  model.actuator.motor_torque = 100.0;
  model.wearer.tremor = 0.0;
  model.wearer.reflex_gain = 0.0;
  return model;
}

struct Rest {
  double swing_rad = 0.0;  ///< from the least to the greatest angle in the last two of twelve seconds
  double angle_rad = 0.0;  ///< at the end
};

Rest held_by_limit(double stiffness) {
  FingerDynamics fingers(servo_glove(FingerKind::kJointLimit), {});
  JointLimits limits{.expiry = std::chrono::hours(1)};
  limits.joints[kPressed] = {.upper = kWall_rad, .stiffness = stiffness, .max_torque = 100.0};
  double least = kAim_rad;
  double greatest = 0.0;
  for (int ms = 0; ms < 12'000; ++ms) {
    fingers.advance(milliseconds(1), every_joint(kAim_rad), true, {.limits = &limits});
    if (ms < 10'000) continue;
    least = std::min(least, fingers.angles()[kPressed]);
    greatest = std::max(greatest, fingers.angles()[kPressed]);
  }
  return {greatest - least, fingers.angles()[kPressed]};
}

Rest held_over_link(double stiffness) {
  constexpr int kPeriod_ms = 17;
  constexpr int kDelay_ms = 20;
  FingerDynamics fingers(servo_glove(FingerKind::kTorque), {});
  std::deque<std::pair<int, double>> on_their_way;
  hands::JointValues torques{};
  double least = kAim_rad;
  double greatest = 0.0;
  for (int ms = 0; ms < 12'000; ++ms) {
    const double depth = std::max(0.0, fingers.angles()[kPressed] - kWall_rad);
    if (ms % kPeriod_ms == 0) on_their_way.emplace_back(ms + kDelay_ms, -stiffness * depth);
    while (!on_their_way.empty() && on_their_way.front().first <= ms) {
      torques[kPressed] = on_their_way.front().second;
      on_their_way.pop_front();
    }
    fingers.advance(milliseconds(1), every_joint(kAim_rad), true, {.torques = torques});
    if (ms < 10'000) continue;
    least = std::min(least, fingers.angles()[kPressed]);
    greatest = std::max(greatest, fingers.angles()[kPressed]);
  }
  return {greatest - least, fingers.angles()[kPressed]};
}

constexpr double kBacklash_rad = 0.00576;

TEST(HeldLimit, IsFifteenTimesAsStiffAsATorqueOverASlowLink) {
  constexpr double kStiffness = 1.4;  // Nm/rad
  EXPECT_GT(held_over_link(kStiffness).swing_rad, 2.0 * kBacklash_rad) << "a limit cycle";
  EXPECT_LT(held_by_limit(15.0 * kStiffness).swing_rad, kBacklash_rad);
}

// The wearer, the limit and the linkage, whose stiffness adds to that of the limit in series, are springs. Friction
// holds the finger within its torque over their stiffness.
TEST(HeldLimit, FingerRestsWhereTheSpringsBalance) {
  const GloveModel model = servo_glove(FingerKind::kJointLimit);
  const double wearer = model.wearer.stiffness + model.wearer.stiffness_per_grip * model.wearer.grip;
  for (const double stiffness : {1.0, 2.0, 5.0}) {
    const double in_series = 1.0 / (1.0 / stiffness + 1.0 / model.actuator.link_stiffness);
    const double balance = (wearer * kAim_rad + in_series * kWall_rad) / (wearer + in_series);
    const double play = model.actuator.coulomb_friction / (wearer + in_series) + 0.5 * kBacklash_rad;
    const Rest rest = held_by_limit(stiffness);
    EXPECT_NEAR(rest.angle_rad, balance, play + 0.001) << stiffness;
    EXPECT_LT(rest.swing_rad, 1e-4) << stiffness;
  }
}

}  // namespace
}  // namespace glissade::devices

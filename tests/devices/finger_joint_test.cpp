#include "glove_model/finger_joint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace glissade::devices {
namespace {

constexpr double kStep = 125e-6;  // s

/// A joint without an actuator, with a range that it never reaches.
FingerJointConstants free_joint() {
  return {.inertia = 6e-5, .lower = -1e6, .upper = 1e6};
}

/// The same with an actuator.
FingerJointConstants driven_joint() {
  FingerJointConstants constants = free_joint();
  constants.is_driven = true;
  constants.actuator_inertia = 2e-3;
  constants.link_stiffness = 10.0;
  constants.link_damping = 0.005;
  return constants;
}

FingerJoint after(double seconds, const FingerJointConstants& constants, const FingerJointLoads& loads) {
  FingerJoint joint(constants, 0.0);
  for (int i = 0; i < std::lround(seconds / kStep); ++i)
    joint.step(kStep, loads);
  return joint;
}

// θ̈ = τ / I. Implicit Euler adds half a step of the rate to the angle.
TEST(FingerJoint, AcceleratesByTorqueOverInertia) {
  constexpr double kTorque = 1e-3;
  constexpr double kSeconds = 0.1;
  const FingerJoint joint = after(kSeconds, free_joint(), {.finger_torque = kTorque});
  const double acceleration = kTorque / 6e-5;
  EXPECT_NEAR(joint.rate(), acceleration * kSeconds, 1e-9);
  EXPECT_NEAR(joint.angle(), 0.5 * acceleration * kSeconds * (kSeconds + kStep), 1e-9);
}

// The step response of an underdamped spring and damper: 1 − e^(−ζωt) (cos ω_d t + ζω/ω_d sin ω_d t).
TEST(FingerJoint, FollowsTheStepResponseOfASpringAndDamper) {
  constexpr double kAim = 0.5;
  constexpr double kStiffness = 0.04;
  constexpr double kDamping = 6e-4;
  const double frequency = std::sqrt(kStiffness / 6e-5);
  const double decay = 0.5 * kDamping / 6e-5;
  const double damped = std::sqrt(frequency * frequency - decay * decay);
  for (const double t : {0.02, 0.05, 0.1, 0.2, 0.5}) {
    const FingerJoint joint = after(t, free_joint(), {.aim = kAim, .stiffness = kStiffness, .damping = kDamping});
    const double rest = std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t));
    EXPECT_NEAR(joint.angle(), kAim * (1.0 - rest), 0.003 * kAim) << t << " s; first order in the step";
  }
}

TEST(FingerJoint, DryFrictionHoldsTorquesUpToItsThreshold) {
  const FingerJointLoads loads{.actuator_torque = 0.0999, .friction_rising = 0.1, .friction_falling = 0.1};
  const FingerJoint joint = after(10.0, driven_joint(), loads);
  EXPECT_EQ(joint.actuator_angle(), 0.0) << "not even a slow creep";
  EXPECT_EQ(joint.actuator_rate(), 0.0);
}

// Above the threshold, the excess accelerates finger and actuator together.
TEST(FingerJoint, DryFrictionTakesItsTorqueFromLargerOnes) {
  const FingerJointLoads loads{.actuator_torque = 0.11, .friction_rising = 0.1, .friction_falling = 0.1};
  const FingerJoint joint = after(0.5, driven_joint(), loads);
  EXPECT_NEAR(joint.actuator_rate(), 0.01 / (2e-3 + 6e-5) * 0.5, 1e-3);
  EXPECT_NEAR(joint.rate(), joint.actuator_rate(), 1e-3);
}

// A moving actuator stops after v² I / (2 f), and stays.
TEST(FingerJoint, DryFrictionStopsAMovingJointForGood) {
  FingerJoint joint = after(0.1, driven_joint(), {.actuator_torque = 0.1});
  const double start = joint.actuator_angle();
  const double rate = joint.actuator_rate();
  for (int i = 0; i < 8000; ++i)
    joint.step(kStep, {.friction_rising = 0.05, .friction_falling = 0.05});
  EXPECT_EQ(joint.actuator_rate(), 0.0);
  const double way = 0.5 * rate * rate * (2e-3 + 6e-5) / 0.05;
  EXPECT_NEAR(joint.actuator_angle() - start, way, 0.02 * way);
}

// A brake that resists one direction only: no torque holds the finger when it opens.
TEST(FingerJoint, FrictionMayResistOneDirectionOnly) {
  const FingerJointLoads closing{.actuator_torque = 0.3, .friction_rising = 0.4};
  EXPECT_EQ(after(1.0, driven_joint(), closing).actuator_angle(), 0.0);
  const FingerJointLoads opening{.actuator_torque = -0.3, .friction_rising = 0.4};
  EXPECT_NEAR(after(0.1, driven_joint(), opening).actuator_rate(), -0.3 / (2e-3 + 6e-5) * 0.1, 0.05);
}

// While the wearer moves the finger to and fro, an actuator that sticks leaves the backlash free, and only that.
TEST(FingerJoint, LosesTheBacklashAsMotion) {
  FingerJointConstants constants = driven_joint();
  constants.backlash = 0.02;
  constants.link_stiffness = 1e4;
  FingerJoint joint(constants, 0.0);
  const auto push = [&](double torque) {
    const FingerJointLoads loads{
        .damping = 0.01, .finger_torque = torque, .friction_rising = 1e3, .friction_falling = 1e3};
    for (int i = 0; i < 8000; ++i)
      joint.step(kStep, loads);
    return joint.angle();
  };
  const double up = push(0.05);
  const double down = push(-0.05);
  EXPECT_NEAR(up - down, 0.02 + 2 * 0.05 / 1e4, 1e-9);
  EXPECT_EQ(joint.actuator_angle(), 0.0);
}

TEST(FingerJoint, TeethPushAndNeverPull) {
  FingerJointConstants constants = driven_joint();
  constants.backlash = 0.01;
  constants.link_damping = 0.5;
  FingerJoint joint(constants, 0.0);
  for (int i = 0; i < 8000; ++i) {
    const double lead = joint.actuator_angle() - joint.angle();
    joint.step(kStep, {.damping = 0.01, .actuator_torque = i / 100 % 2 == 0 ? 0.2 : -0.2});
    ASSERT_GE(joint.link_torque() * lead, 0.0) << i;
  }
}

// Within the backlash, no torque passes, and a free finger keeps its rate.
TEST(FingerJoint, TransmitsNothingWithinTheBacklash) {
  FingerJointConstants constants = driven_joint();
  constants.backlash = 0.5;
  const FingerJointLoads loads{.actuator_torque = 1e-3};
  const FingerJoint joint = after(0.1, constants, loads);
  EXPECT_EQ(joint.angle(), 0.0);
  EXPECT_NEAR(joint.actuator_rate(), 1e-3 / 2e-3 * 0.1, 1e-12);
}

// Two inertias on a spring of 10 Nm/rad; the reduced inertia gives the period.
TEST(FingerJoint, SpringOfTheTransmissionHasItsPeriod) {
  FingerJointConstants constants = driven_joint();
  constants.link_damping = 0.0;
  constants.inertia = 2e-3;
  constants.link_stiffness = 1.0;
  FingerJoint joint(constants, 0.0);
  const double period = 2.0 * std::numbers::pi * std::sqrt(1e-3 / 1.0);
  double sum = 0.0;  // of the torque over a period, which is that of the mean
  const int steps = static_cast<int>(std::lround(period / kStep));
  for (int i = 0; i < steps; ++i) {
    joint.step(kStep, {.actuator_torque = 0.1});
    sum += joint.link_torque();
  }
  EXPECT_NEAR(sum / steps, 0.05, 0.001) << "half of the torque moves the finger";
  EXPECT_NEAR(joint.link_torque(), 0.0, 0.003) << "after a period, the spring is at its start";
}

TEST(FingerJoint, StopsAtTheEndOfItsRange) {
  FingerJointConstants constants = free_joint();
  constants.upper = 0.3;
  const FingerJoint joint = after(1.0, constants, {.finger_torque = 0.01});
  EXPECT_EQ(joint.angle(), 0.3);
  EXPECT_EQ(joint.rate(), 0.0);
}

TEST(FingerJoint, IsStableWithAnyStiffness) {
  FingerJointConstants constants = driven_joint();
  constants.inertia = 1e-6;
  constants.link_stiffness = 1e5;
  const FingerJoint joint = after(1.0, constants, {.aim = 0.2, .stiffness = 100.0, .damping = 0.0});
  EXPECT_TRUE(std::isfinite(joint.angle()));
  EXPECT_LT(std::abs(joint.angle()), 0.5);
}

struct Cycle {
  double amplitude_rad = 0.0;
  double rate_rad_per_s = 0.0;
};

/// The limit cycle of a motor with inertia J and damping b, which a spring K leads back by the angle behind a backlash.
/// By the describing function a + j c of a load that stays where it is within the backlash (Gelb and Vander Velde,
/// Multiple-Input Describing Functions, 1968), K (a + j c) = J ω² − j b ω. With u = 1 − backlash / amplitude,
/// a = (π/2 + asin u + u √(1 − u²)) / π and c = −(1 − u²) / π, so ω = K (1 − u²) / (π b).
Cycle described_cycle(double inertia, double damping, double stiffness, double backlash) {
  double lower = 0.0;
  double upper = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double u = 0.5 * (lower + upper);
    const double rate = stiffness * (1.0 - u * u) / (std::numbers::pi * damping);
    const double a = (0.5 * std::numbers::pi + std::asin(u) + u * std::sqrt(1.0 - u * u)) / std::numbers::pi;
    (stiffness * a < inertia * rate * rate ? lower : upper) = u;
  }
  return {backlash / (1.0 - lower), stiffness * (1.0 - lower * lower) / (std::numbers::pi * damping)};
}

// A light finger with some damping stays where it is within the backlash. The describing function is an approximation.
TEST(FingerJoint, HuntsInItsBacklashAsTheDescribingFunctionSays) {
  constexpr double kStiffness = 1.0;
  constexpr double kOfFinger = 1e-3;  // damping, Nm s/rad
  FingerJointConstants constants = driven_joint();
  constants.inertia = 1e-7;
  constants.viscous_friction = 0.01;
  constants.backlash = 0.02;
  constants.link_stiffness = 1e4;
  constants.link_damping = 1.0;
  FingerJoint joint(constants, 0.3);
  double greatest = 0.0;
  int crossings = 0;
  constexpr int kSeconds = 8;
  for (int i = 0; i < std::lround(2 * kSeconds / kStep); ++i) {
    const double before = joint.actuator_angle();
    joint.step(kStep, {.damping = kOfFinger, .actuator_torque = -kStiffness * joint.angle()});
    if (i < std::lround(kSeconds / kStep)) continue;  // until it has settled
    greatest = std::max(greatest, joint.actuator_angle());
    crossings += before < 0.0 && joint.actuator_angle() >= 0.0 ? 1 : 0;
  }
  const Cycle cycle = described_cycle(constants.actuator_inertia, constants.viscous_friction + kOfFinger, kStiffness,
                                      constants.backlash);
  EXPECT_NEAR(greatest, cycle.amplitude_rad, 0.1 * cycle.amplitude_rad);
  EXPECT_NEAR(2.0 * std::numbers::pi * crossings / kSeconds, cycle.rate_rad_per_s, 0.05 * cycle.rate_rad_per_s);
}

}  // namespace
}  // namespace glissade::devices

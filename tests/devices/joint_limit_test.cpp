/// Limits that a device holds by itself: their torque, and what the envelope lets pass.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

#include "lcm/glove_messages.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kIndexMcp = 4;
const JointLimit kAtHalf{.upper = 0.5, .stiffness = 2.0, .max_torque = 0.4};

TEST(JointLimit, PushesBackBeyondTheRangeOnly) {
  const JointLimit limit{.lower = -0.1, .upper = 0.5, .stiffness = 2.0, .max_torque = 0.4};
  EXPECT_EQ(limit_torque(limit, 0.5, 3.0), 0.0);
  EXPECT_NEAR(limit_torque(limit, 0.6, 0.0), -0.2, 1e-12);
  EXPECT_NEAR(limit_torque(limit, -0.2, 0.0), 0.2, 1e-12);
  EXPECT_EQ(limit_torque(limit, 1.0, 0.0), -0.4) << "the cap";
}

TEST(JointLimit, DampingNeverPulls) {
  JointLimit limit = kAtHalf;
  limit.damping = 0.1;
  EXPECT_NEAR(limit_torque(limit, 0.55, 1.0), -0.2, 1e-12);
  EXPECT_NEAR(limit_torque(limit, 0.55, -1.0), 0.0, 1e-12) << "a finger that leaves fast";
  EXPECT_EQ(limit_torque(limit, 0.45, 5.0), 0.0) << "and one that is not there yet";
}

TEST(JointLimit, StoredEnergyIsTheWorkAgainstTheTorque) {
  double work = 0.0;
  constexpr double kStep_rad = 1e-5;
  for (double angle = 0.5; angle < 0.9; angle += kStep_rad)
    work -= limit_torque(kAtHalf, angle + 0.5 * kStep_rad, 0.0) * kStep_rad;
  EXPECT_NEAR(stored_energy(kAtHalf, 0.9), work, 1e-5);
  EXPECT_EQ(stored_energy(kAtHalf, 0.5), 0.0);
}

DeviceDescriptor servo_glove() {
  DeviceDescriptor glove = simulated_glove_descriptor();  // 0.5 Nm a joint, 0.02 Nm s/rad, 1000 Hz
  glove.finger_command = FingerCommand::kJointLimit;
  glove.limit_rate = 500.0;
  glove.limit_delay = milliseconds(1);
  glove.max_limit_stiffness = 20.0;
  return glove;
}

TEST(PassiveLimitStiffness, IsThatOfTheOwnLoop) {
  DeviceDescriptor glove = servo_glove();
  EXPECT_NEAR(passive_limit_stiffness(glove), 0.02 / (0.5 / 500.0 + 1e-3), 1e-12);
  glove.joint_friction = 0.005;
  EXPECT_NEAR(passive_limit_stiffness(glove), (0.02 + 0.005 / 0.5) / 0.002, 1e-12) << "dry friction at 0.5 rad/s";
  glove.max_limit_stiffness = 3.0;
  EXPECT_EQ(passive_limit_stiffness(glove), 3.0);
  glove.joint_friction = 0.01;
  glove.joint_resolution = 0.02;
  EXPECT_NEAR(passive_limit_stiffness(glove), 1.0, 1e-12) << "no buzz within a step of the sensor";
  glove.finger_command = FingerCommand::kBrake;
  EXPECT_EQ(passive_limit_stiffness(glove), 3.0) << "a brake never pushes";
  glove.finger_command = FingerCommand::kTorque;
  EXPECT_EQ(passive_limit_stiffness(glove), 0.0);
}

/// The envelope of a servo glove, a millisecond a tick, without a link.
class LimitsInEnvelope : public testing::Test {
 protected:
  JointLimit tick(const JointLimit& wanted) {
    now_ += milliseconds(1);
    GloveCommand command;
    command.joint_limits.joints[kIndexMcp] = wanted;
    ++state_.sequence;
    state_.time = command.state_time = now_;
    safe_ = envelope_.limit(command, state_, now_);
    return safe_.values().joint_limits.joints[kIndexMcp];
  }
  /// The same for so many ticks.
  JointLimit hold(const JointLimit& wanted, int ticks) {
    JointLimit given;
    for (int i = 0; i < ticks; ++i)
      given = tick(wanted);
    return given;
  }
  double torque() const {
    return limit_torque(safe_.values().joint_limits.joints[kIndexMcp], state_.joint_angles[kIndexMcp], 0.0);
  }

  DeviceDescriptor device_ = servo_glove();
  SafetyEnvelope envelope_{device_};
  GloveState state_;
  SafeCommand safe_;
  std::chrono::nanoseconds now_{milliseconds(100)};
};

TEST_F(LimitsInEnvelope, PassWithinStiffnessAndTorqueOfTheDevice) {
  const JointLimit given = hold({.upper = 0.5, .stiffness = 1e3, .max_torque = 7.0}, 300);
  EXPECT_EQ(given.upper, 0.5);
  EXPECT_EQ(given.stiffness, passive_limit_stiffness(device_));
  EXPECT_EQ(given.max_torque, device_.max_joint_torque);
  EXPECT_TRUE(safe_.reasons().joints_limited);
}

TEST_F(LimitsInEnvelope, StandingLimitStopsAFastFingerAtOnce) {
  hold(kAtHalf, 300);
  state_.joint_angles[kIndexMcp] = 0.6;
  tick(kAtHalf);
  EXPECT_NEAR(torque(), -0.2, 1e-12);
}

TEST_F(LimitsInEnvelope, TorqueOfATighteningLimitRisesAtTheDevicesRate) {
  device_.max_joint_torque_rate = 10.0;
  envelope_ = SafetyEnvelope(device_);
  hold(kAtHalf, 300);
  state_.joint_angles[kIndexMcp] = 0.4;
  JointLimit tight = kAtHalf;
  tight.upper = 0.3;
  double last = 0.0;
  for (int i = 0; i < 50; ++i) {
    tick(tight);
    EXPECT_LE(std::abs(torque()), std::abs(last) + 10.0 * 1e-3 + 1e-12);
    last = torque();
  }
  EXPECT_NEAR(last, -0.2, 1e-12);
}

TEST_F(LimitsInEnvelope, LimitThatOpensLetsGoAtOnce) {
  hold(kAtHalf, 300);
  state_.joint_angles[kIndexMcp] = 0.6;
  tick(kAtHalf);
  JointLimit wide = kAtHalf;
  wide.upper = 0.7;
  EXPECT_EQ(tick(wide), wide);
  EXPECT_EQ(tick({}), JointLimit{});
}

// A limit that follows a finger inwards and opens before it comes back would shake it.
TEST_F(LimitsInEnvelope, LimitThatPumpsRunsOutOfEnergy) {
  double pumped = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    JointLimit limit = kAtHalf;
    limit.upper = i % 2 == 0 ? 0.2 : 0.5;
    state_.joint_angles[kIndexMcp] = i % 2 == 0 ? 0.5 : 0.2;  // pressed at 0.5, and home without a torque
    tick(limit);
    pumped += stored_energy(safe_.values().joint_limits.joints[kIndexMcp], state_.joint_angles[kIndexMcp]);
  }
  EXPECT_LE(pumped, 20e-3 + 20.0 * 5e-3 + 1e-3);
  EXPECT_GE(pumped, 5e-3) << "and uses it";
}

TEST_F(LimitsInEnvelope, ReturnToAFingerThatRestsDeepInAnObject) {
  state_.joint_angles[kIndexMcp] = 0.7;
  hold(kAtHalf, 100);
  EXPECT_GT(torque(), -0.4 + 1e-3) << "0.7 rad would store 40 mJ";
  hold(kAtHalf, 500);
  EXPECT_NEAR(torque(), -0.4, 1e-12);
}

// At each end of its stroke a finger is slow, but it does not rest.
TEST_F(LimitsInEnvelope, SwingingFingerIsNotFedWhileItTurns) {
  double pumped = 0.0;
  JointLimit given;
  double angle = 0.6;
  for (int ms = 0; ms < 20'000; ++ms) {
    const double phase = 2.0 * std::numbers::pi * 5.0 * 1e-3 * ms;
    const double step = 0.6 + 0.05 * std::sin(phase) - angle;
    pumped += limit_torque(given, angle + 0.5 * step, 0.0) * step;
    angle = state_.joint_angles[kIndexMcp] = angle + step;
    JointLimit limit = kAtHalf;
    if (std::cos(phase) > 0.0) limit.upper = 0.7;  // only while the finger goes back does the limit push
    given = tick(limit);
  }
  EXPECT_LE(pumped, 20e-3 + 20.0 * 5e-3 + 1e-3);
}

TEST_F(LimitsInEnvelope, OpenInAFadeAndReturnSoftly) {
  hold(kAtHalf, 300);
  state_.joint_angles[kIndexMcp] = 0.65;
  tick(kAtHalf);
  const double pressed = torque();
  EXPECT_LT(pressed, -0.25);
  state_.is_enabled = false;
  double last = pressed;
  for (int i = 0; i < 8; ++i) {
    tick(kAtHalf);
    EXPECT_GE(torque(), last);
    last = torque();
  }
  EXPECT_EQ(last, 0.0);
  EXPECT_FALSE(safe_.values().joint_limits.any());
  state_.is_enabled = true;
  tick(kAtHalf);
  EXPECT_GT(torque(), -0.01);
  hold(kAtHalf, 300);
  EXPECT_NEAR(torque(), pressed, 1e-12);
}

TEST_F(LimitsInEnvelope, LimitOpensAtOnceThoughAnotherFingerHasNoEnergy) {
  constexpr std::size_t kMiddleMcp = 7;
  hold(kAtHalf, 300);
  state_.joint_angles[kIndexMcp] = 0.55;
  state_.joint_angles[kMiddleMcp] = 1.2;
  for (int i = 0; i < 100; ++i) {
    GloveCommand command;
    command.joint_limits.joints[kIndexMcp] = i < 50 ? kAtHalf : JointLimit{};
    command.joint_limits.joints[kMiddleMcp] = kAtHalf;  // deep: the account does not pay for all of it
    now_ += milliseconds(1);
    ++state_.sequence;
    state_.time = command.state_time = now_;
    safe_ = envelope_.limit(command, state_, now_);
    EXPECT_TRUE(safe_.reasons().energy_limited || i < 20) << i;
    const JointLimit& index = safe_.values().joint_limits.joints[kIndexMcp];
    ASSERT_EQ(index, i < 50 ? kAtHalf : JointLimit{}) << i;
  }
}

TEST_F(LimitsInEnvelope, TorqueTurnsAtTheDevicesRate) {
  device_.max_joint_torque_rate = 10.0;
  envelope_ = SafetyEnvelope(device_);
  hold({.lower = 0.1, .stiffness = 2.0, .max_torque = 0.4}, 1000);
  EXPECT_NEAR(torque(), 0.2, 1e-12);
  double last = torque();
  for (int i = 0; i < 100; ++i) {
    tick({.upper = -0.1, .stiffness = 2.0, .max_torque = 0.4});
    EXPECT_GE(torque(), std::min(last, 0.0) - 10.0 * 1e-3 - 1e-12) << "a torque that opens may vanish at once";
    last = torque();
  }
  EXPECT_NEAR(last, -0.2, 1e-12);
}

// States that come late again and again must not use up the force of a finger that presses.
TEST_F(LimitsInEnvelope, ManyShortInterruptionsCostNothing) {
  hold(kAtHalf, 300);
  state_.joint_angles[kIndexMcp] = 0.65;
  for (int i = 0; i < 50; ++i) {
    state_.is_enabled = false;
    hold(kAtHalf, 20);
    state_.is_enabled = true;
    hold(kAtHalf, 300);
    ASSERT_NEAR(torque(), -0.3, 1e-12) << i;
  }
}

// Nobody calls the envelope, so the device opens its limits, and the finger goes in against nothing.
TEST_F(LimitsInEnvelope, WhatTheDeviceHasDroppedReturnsSoftlyAndIsPaidFor) {
  hold(kAtHalf, 400);
  double got = 0.0;
  for (int i = 0; i < 30; ++i) {
    now_ += milliseconds(100);
    state_.joint_angles[kIndexMcp] = 0.7;
    tick(kAtHalf);
    ASSERT_LT(std::abs(torque()), 0.05) << "the device pushed with nothing";
    for (int ms = 0; ms < 100; ++ms) {
      got -= 2e-3 * torque();
      state_.joint_angles[kIndexMcp] -= 2e-3;
      tick(kAtHalf);
    }
  }
  EXPECT_LE(got, 0.1) << "the account of the limits has 20 mJ and 5 mW";
}

TEST_F(LimitsInEnvelope, WhatTheDeviceHasDroppedReturnsToAFingerThatStayed) {
  hold(kAtHalf, 300);
  state_.joint_angles[kIndexMcp] = 0.65;
  for (int i = 0; i < 50; ++i) {
    hold(kAtHalf, 300);
    ASSERT_NEAR(torque(), -0.3, 1e-12) << i;
    now_ += milliseconds(30);
  }
}

TEST_F(LimitsInEnvelope, NumbersThatAreNoneOpenAllLimits) {
  hold(kAtHalf, 300);
  JointLimit bad = kAtHalf;
  bad.upper = std::numeric_limits<double>::quiet_NaN();
  hold(bad, 8);
  EXPECT_TRUE(safe_.reasons().not_finite);
  EXPECT_FALSE(safe_.values().joint_limits.any());
}

TEST_F(LimitsInEnvelope, ExpireAfterThreePeriodsOfASlowDevice) {
  tick(kAtHalf);
  EXPECT_EQ(safe_.values().joint_limits.expiry, milliseconds(10));
  device_.update_rate = 60.0;
  envelope_ = SafetyEnvelope(device_);
  tick(kAtHalf);
  EXPECT_NEAR(std::chrono::duration<double>(safe_.values().joint_limits.expiry).count(), 0.05, 1e-6);
}

// A joint without an actuator would use up the energy of those that have one.
TEST_F(LimitsInEnvelope, JointWithoutAnActuatorGetsNone) {
  constexpr std::size_t kMiddleMcp = 7;
  device_.undriven_joints.set(kMiddleMcp);
  envelope_ = SafetyEnvelope(device_);
  state_.joint_angles[kMiddleMcp] = 1.2;
  state_.joint_angles[kIndexMcp] = 0.55;
  GloveCommand command;
  command.joint_limits.joints[kMiddleMcp] = command.joint_limits.joints[kIndexMcp] = kAtHalf;
  command.joint_torques[kMiddleMcp] = command.joint_torques[kIndexMcp] = 0.1;
  for (int i = 0; i < 300; ++i) {
    now_ += milliseconds(1);
    ++state_.sequence;
    state_.time = command.state_time = now_;
    safe_ = envelope_.limit(command, state_, now_);
    EXPECT_FALSE(safe_.reasons().energy_limited) << i;
  }
  EXPECT_EQ(safe_.values().joint_limits.joints[kMiddleMcp], JointLimit{});
  EXPECT_EQ(safe_.values().joint_limits.joints[kIndexMcp], kAtHalf);
  EXPECT_EQ(safe_.values().joint_torques[kMiddleMcp], 0.0);
  EXPECT_EQ(safe_.values().joint_torques[kIndexMcp], 0.1);
}

TEST_F(LimitsInEnvelope, DampingIsWhatThePassiveStiffnessLeaves) {
  JointLimit damped = kAtHalf;
  damped.damping = 1.0;
  EXPECT_NEAR(hold(damped, 300).damping, 0.02 - 2.0 * (0.5 / 500.0 + 1e-3), 1e-12);
}

TEST_F(LimitsInEnvelope, DeviceOfTorquesGetsNone) {
  envelope_ = SafetyEnvelope(simulated_glove_descriptor());
  EXPECT_EQ(hold(kAtHalf, 300), JointLimit{});
}

TEST(LimitsOnTheWire, ArriveWhole) {
  GloveCommand sent;
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    const double number = 0.01 * static_cast<double>(j + 1);
    sent.joint_limits.joints[j] = {-number, 2.0 * number, 3.0 * number, 4.0 * number, 5.0 * number};
  }
  sent.joint_limits.expiry = milliseconds(50);
  CommandHeader header;
  GloveCommand received;
  ASSERT_EQ(decode(encode(CommandHeader{1, 7, 9}, sent), header, received), MessageError::kNone);
  EXPECT_EQ(received.joint_limits, sent.joint_limits);
  sent.joint_limits.joints[21].upper = 6.1;
  EXPECT_EQ(decode(encode(CommandHeader{1, 7, 9}, sent), header, received), MessageError::kOutOfRange);
}

/// Two joints, of which the second one turns twice as far and the other way.
constexpr std::array<JointWay, 2> kTogether{{{4, 1.0}, {5, -2.0}}};

TEST(WayLeft, IsThatOfTheContactThatBothJointsClose) {
  JointLimits limits;
  EXPECT_EQ(way_left(kTogether, limits, {}), std::numeric_limits<double>::infinity());
  limits.joints[4] = {.upper = 0.5, .stiffness = 1.0, .max_torque = 0.1};
  EXPECT_NEAR(way_left(kTogether, limits, {}), 0.5, 1e-12);
  limits.joints[5] = {.lower = -0.5, .stiffness = 1.0, .max_torque = 0.1};
  // At a way of w, the shares are w / 0.5 and 2 w / 0.5.
  EXPECT_NEAR(way_left(kTogether, limits, {}), 1.0 / 6.0, 1e-12);
  limits.joints[5].max_torque = 0.0;
  EXPECT_NEAR(way_left(kTogether, limits, {}), 0.5, 1e-12) << "no torque, no limit";
}

TEST(WayLeft, IsNotPositiveAtALimitAndBeyondIt) {
  JointLimits limits;
  limits.joints[4] = {.upper = 0.5, .stiffness = 1.0, .max_torque = 0.1};
  limits.joints[5] = {.lower = -0.5, .stiffness = 1.0, .max_torque = 0.1};
  hands::JointValues angles{};
  angles[4] = 0.5;
  EXPECT_EQ(way_left(kTogether, limits, angles), 0.0);
  angles[5] = -0.7;
  EXPECT_NEAR(way_left(kTogether, limits, angles), -0.1, 1e-12);
}

}  // namespace
}  // namespace glissade::devices

/// Half-spaces that a device holds by itself: what the envelope lets pass, and what arrives.

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

#include "lcm/glove_messages.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

DeviceDescriptor holding_arm() {
  DeviceDescriptor arm = simulated_glove_descriptor();  // 20 N, 1 Nm, 4000 N/m, 10 Nm/rad, 1000 Hz
  arm.tool_command = ToolCommand::kHalfSpaces;
  arm.tool_rate = 1000.0;
  return arm;
}

/// A plane across the z axis, at the hand root, of 1000 N/m.
HalfSpaces floor_at(double z, const Vector3d& normal = Vector3d::UnitZ()) {
  HalfSpaces floor;
  floor.count = 1;
  floor.rows[0] = {normal, Vector3d::Zero(), z};
  floor.stiffness = 1000.0;
  floor.rotational_stiffness = 5.0;
  floor.max_force = 20.0;
  floor.max_torque = 1.0;
  return floor;
}

/// The envelope of the arm, a millisecond a tick, without a link.
class HalfSpacesInEnvelope : public testing::Test {
 protected:
  const HalfSpaces& tick(const HalfSpaces& wanted) {
    now_ += milliseconds(1);
    GloveCommand command;
    command.half_spaces = wanted;
    ++state_.sequence;
    state_.time = command.state_time = now_;
    safe_ = envelope_.limit(command, state_, now_);
    return safe_.values().half_spaces;
  }
  const HalfSpaces& hold(const HalfSpaces& wanted, int ticks) {
    for (int i = 0; i < ticks; ++i)
      tick(wanted);
    return safe_.values().half_spaces;
  }
  /// Moves the hand within so many ticks. Returns the work on it (J).
  double glide_to(double z, const HalfSpaces& wanted, int ticks) {
    const double step = (z - state_.X_WH.translation().z()) / ticks;
    double work = 0.0;
    for (int i = 0; i < ticks; ++i) {
      const double before = force().z();
      move_to(state_.X_WH.translation().z() + step);
      work += 0.5 * (before + force().z()) * step;
      tick(wanted);
    }
    return work;
  }
  void move_to(double z) { state_.X_WH.translation().z() = z; }
  Vector3d force() const { return half_space_wrench(safe_.values().half_spaces, state_.X_WH).f_H_W; }
  double stored() const { return stored_energy(safe_.values().half_spaces, state_.X_WH); }

  DeviceDescriptor arm_ = holding_arm();
  SafetyEnvelope envelope_{arm_};
  GloveState state_;
  SafeCommand safe_;
  std::chrono::nanoseconds now_{milliseconds(100)};
};

TEST_F(HalfSpacesInEnvelope, PassWithinForceTorqueAndStiffnessOfTheDevice) {
  HalfSpaces wanted = floor_at(0.0);
  wanted.stiffness = 1e5;
  wanted.rotational_stiffness = 1e3;
  wanted.max_force = 1e3;
  wanted.max_torque = 1e3;
  const HalfSpaces given = hold(wanted, 300);
  EXPECT_EQ(given.stiffness, 4000.0) << "0.5 ms times 2 N s/m";
  EXPECT_EQ(given.rotational_stiffness, 10.0);
  EXPECT_EQ(given.max_force, 20.0);
  EXPECT_EQ(given.max_torque, 1.0);
}

TEST_F(HalfSpacesInEnvelope, AreSofterFarFromTheHand) {
  HalfSpaces wanted = floor_at(0.0);
  wanted.p_HR = Vector3d(0.2, 0.0, 0.0);
  const HalfSpaces given = hold(wanted, 300);
  const double L = arm_.damping / 0.5e-3;
  const double L_r = arm_.rotational_damping / 0.5e-3;
  const double l2 = 0.04;
  EXPECT_NEAR(1.0 / given.stiffness, 1.0 / L + l2 / (L_r - given.rotational_stiffness), 1e-8);
  EXPECT_NEAR(given.rotational_stiffness / given.stiffness, 5.0 / 1000.0, 1e-12);
}

TEST_F(HalfSpacesInEnvelope, DampingIsWhatTheStiffnessLeaves) {
  HalfSpaces wanted = floor_at(0.0);
  wanted.damping = 100.0;
  EXPECT_NEAR(hold(wanted, 300).damping, arm_.damping - 1000.0 * 0.5e-3, 1e-12);
}

TEST_F(HalfSpacesInEnvelope, StandingPlaneStopsAFastHandAtOnce) {
  hold(floor_at(0.0), 300);
  move_to(-15e-3);
  tick(floor_at(0.0));
  EXPECT_NEAR(force().z(), 15.0, 1e-12);
}

TEST_F(HalfSpacesInEnvelope, ForceOfATighteningPlaneRisesAtTheDevicesRate) {
  arm_.max_force_rate = 2000.0;
  envelope_ = SafetyEnvelope(arm_);
  hold(floor_at(-1.0), 300);
  double last = 0.0;
  for (int i = 0; i < 20; ++i) {
    tick(floor_at(10e-3));
    EXPECT_LE(force().z(), last + 2.0 + 1e-9);
    last = force().z();
  }
  EXPECT_NEAR(last, 10.0, 1e-9);
}

TEST_F(HalfSpacesInEnvelope, ForceOfAPlaneThatVanishesOrTurnsChangesAtTheDevicesRate) {
  arm_.max_force_rate = 2000.0;
  envelope_ = SafetyEnvelope(arm_);
  hold(floor_at(-1.0), 300);
  for (const HalfSpaces& wanted : {floor_at(10e-3), floor_at(10e-3, Vector3d::UnitX()), HalfSpaces{}, floor_at(10e-3),
                                   floor_at(10e-3, -Vector3d::UnitZ())}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3d last = force();
      tick(wanted);
      ASSERT_LE((force() - last).norm(), 2.0 + 1e-9);
    }
    EXPECT_NEAR((force() - half_space_wrench(wanted, state_.X_WH).f_H_W).norm(), 0.0, 1e-9);
  }
}

TEST_F(HalfSpacesInEnvelope, DropInAFadeAndReturnSoftly) {
  hold(floor_at(0.0), 300);
  move_to(-15e-3);
  tick(floor_at(0.0));
  state_.is_enabled = false;
  double last = force().z();
  for (int i = 0; i < 8; ++i) {
    tick(floor_at(0.0));
    EXPECT_LE(force().z(), last);
    last = force().z();
  }
  EXPECT_FALSE(safe_.values().half_spaces.any());
  state_.is_enabled = true;
  tick(floor_at(0.0));
  EXPECT_LT(force().z(), 0.2);
  hold(floor_at(0.0), 300);
  EXPECT_NEAR(force().z(), 15.0, 1e-9);
}

TEST_F(HalfSpacesInEnvelope, FadeNoFasterThanForceAndTorqueOfTheDeviceMayFall) {
  arm_.max_force_rate = 1'000.0;
  arm_.max_torque_rate = 50.0;
  envelope_ = SafetyEnvelope(arm_);
  HalfSpaces floor = floor_at(0.0);
  floor.rows[0].r_W = Vector3d(0.1, 0.0, 0.0);
  hold(floor, 300);
  glide_to(-20e-3, floor, 40);
  hold(floor, 100);
  state_.is_enabled = false;
  HandWrench last = half_space_wrench(safe_.values().half_spaces, state_.X_WH);
  ASSERT_GT(last.t_H_W.norm(), 0.5);
  for (int i = 0; i < 30; ++i) {
    tick(floor);
    const HandWrench wrench = half_space_wrench(safe_.values().half_spaces, state_.X_WH);
    EXPECT_LE((wrench.f_H_W - last.f_H_W).norm(), 1.0 + 1e-9);
    EXPECT_LE((wrench.t_H_W - last.t_H_W).norm(), 0.05 + 1e-9);
    last = wrench;
  }
  EXPECT_FALSE(safe_.values().half_spaces.any());
}

TEST_F(HalfSpacesInEnvelope, ANegativeCapOfTheTorqueIsNone) {
  HalfSpaces floor = floor_at(0.0);
  floor.rows[0].r_W = Vector3d(0.1, 0.0, 0.0);
  floor.max_torque = -1e6;
  hold(floor, 300);
  glide_to(-10e-3, floor, 20);
  hold(floor, 100);
  const HandWrench wrench = half_space_wrench(safe_.values().half_spaces, state_.X_WH);
  EXPECT_GT(wrench.f_H_W.z(), 1.0);
  EXPECT_EQ(wrench.t_H_W.norm(), 0.0);
}

// A plane that pushes a hand out and is not there when it comes back would shake it.
TEST_F(HalfSpacesInEnvelope, PlaneThatPumpsRunsOutOfEnergy) {
  hold(floor_at(-1.0), 1'000);
  double pumped = 0.0;
  for (int ms = 0; ms < 20'000; ++ms) {
    const double phase = 2.0 * std::numbers::pi * 5.0 * 1e-3 * ms;
    const bool goes_out = std::sin(phase) < 0.0;
    pumped += glide_to(-7.5e-3 * (1.0 - std::cos(phase)), floor_at(goes_out ? 0.0 : -1.0), 1);
  }
  EXPECT_LE(pumped, 0.1 + 20.0 * 5e-3 + 1e-3);
  EXPECT_GE(pumped, 0.1) << "and uses it";
}

TEST_F(HalfSpacesInEnvelope, ReturnToAHandThatRestsDeepInAnObject) {
  move_to(-60e-3);
  hold(floor_at(0.0), 2'000);
  EXPECT_NEAR(force().z(), 20.0, 1e-9) << "promise 11: it needs 1 J";
}

TEST_F(HalfSpacesInEnvelope, ManyShortInterruptionsCostNothing) {
  hold(floor_at(0.0), 300);
  move_to(-15e-3);
  for (int i = 0; i < 50; ++i) {
    state_.is_enabled = false;
    hold(floor_at(0.0), 20);
    state_.is_enabled = true;
    hold(floor_at(0.0), 300);
    ASSERT_NEAR(force().z(), 15.0, 1e-9) << i;
  }
}

/// Time in which nobody calls the envelope, so that the device drops its half-spaces.
TEST_F(HalfSpacesInEnvelope, WhatTheDeviceHasDroppedReturnsSoftlyAndIsPaidFor) {
  hold(floor_at(0.0), 2'000);
  double got = 0.0;
  for (int i = 0; i < 30; ++i) {
    now_ += milliseconds(100);
    move_to(-50e-3);
    tick(floor_at(0.0));
    ASSERT_LT(force().z(), 1.0) << "the device pushed with nothing";
    got += glide_to(-50e-3, floor_at(0.0), 100);
    got += glide_to(0.0, floor_at(0.0), 800);
  }
  EXPECT_LE(got, 0.1 + 1.0 + 0.3 * 32.0) << "promise 9";
}

TEST_F(HalfSpacesInEnvelope, WhatTheDeviceHasDroppedReturnsToAHandThatStayed) {
  hold(floor_at(0.0), 300);
  glide_to(-15e-3, floor_at(0.0), 100);
  for (int i = 0; i < 50; ++i) {
    now_ += milliseconds(30);
    hold(floor_at(0.0), 300);
    ASSERT_NEAR(force().z(), 15.0, 1e-9) << i;
  }
}

TEST_F(HalfSpacesInEnvelope, StayWithTheDeviceThroughAShortHalt) {
  hold(floor_at(0.0), 300);
  glide_to(-15e-3, floor_at(0.0), 100);
  now_ += milliseconds(8);
  tick(floor_at(0.0));
  EXPECT_NEAR(force().z(), 15.0, 1e-9);
}

// A hand that goes in without a force puts nothing in, and one that goes out in the fade has got it back.
TEST_F(HalfSpacesInEnvelope, InterruptionsPayNoMoreThanPromised) {
  hold(floor_at(0.0), 300);
  double got = 0.0;
  for (int i = 0; i < 200; ++i) {
    state_.is_enabled = false;
    got += glide_to(-15e-3, floor_at(0.0), 50);
    state_.is_enabled = true;
    got += glide_to(-15e-3, floor_at(0.0), 50);
    state_.is_enabled = false;
    got += glide_to(0.0, floor_at(0.0), 5);
  }
  EXPECT_LE(got, 0.1 + 1.0 + 0.3 * 21.0) << "promise 9: 1 J and 0.3 W for returns";
  EXPECT_GE(got, 0.1);
}

TEST_F(HalfSpacesInEnvelope, BodyThatPushesPaysForItself) {
  hold(floor_at(0.0), 300);
  double supply = 0.0;
  for (int ms = 0; ms < 400; ++ms) {  // the floor lifts the hand at 0.1 m/s with 10 N
    now_ += milliseconds(1);
    GloveCommand command;
    command.session = 1;
    command.sequence = ms;
    command.half_spaces = floor_at(10e-3 + 1e-4 * ms);
    command.supply = supply += 1e-3;
    move_to(1e-4 * ms);
    ++state_.sequence;
    state_.time = command.state_time = now_;
    safe_ = envelope_.limit(command, state_, now_);
    if (ms > 50) {
      ASSERT_NEAR(force().z(), 10.0, 0.5) << ms;
    }
  }
}

TEST_F(HalfSpacesInEnvelope, NumbersThatAreNoneDropAllHalfSpaces) {
  hold(floor_at(0.0), 300);
  HalfSpaces bad = floor_at(0.0);
  bad.rows[0].bound = std::numeric_limits<double>::quiet_NaN();
  hold(bad, 8);
  EXPECT_TRUE(safe_.reasons().not_finite);
  EXPECT_FALSE(safe_.values().half_spaces.any());
}

TEST_F(HalfSpacesInEnvelope, ExpireAfterThreePeriodsOfASlowDevice) {
  tick(floor_at(0.0));
  EXPECT_EQ(safe_.values().half_spaces.expiry, milliseconds(10));
  arm_.update_rate = 60.0;
  envelope_ = SafetyEnvelope(arm_);
  tick(floor_at(0.0));
  EXPECT_NEAR(std::chrono::duration<double>(safe_.values().half_spaces.expiry).count(), 0.05, 1e-6);
}

TEST_F(HalfSpacesInEnvelope, DeviceGetsAWrenchOrHalfSpacesAndNeverBoth) {
  GloveCommand both;
  both.f_H_W.z() = 5.0;
  both.half_spaces = floor_at(0.0);
  for (const ToolCommand kind : {ToolCommand::kWrench, ToolCommand::kHalfSpaces}) {
    arm_.tool_command = kind;
    envelope_ = SafetyEnvelope(arm_);
    for (int i = 0; i < 300; ++i) {
      now_ += milliseconds(1);
      ++state_.sequence;
      state_.time = both.state_time = now_;
      safe_ = envelope_.limit(both, state_, now_);
    }
    EXPECT_EQ(safe_.values().half_spaces.any(), kind == ToolCommand::kHalfSpaces);
    EXPECT_EQ(safe_.values().f_H_W.z() != 0.0, kind == ToolCommand::kWrench);
  }
}

TEST(HalfSpacesOnTheWire, ArriveWhole) {
  GloveCommand sent;
  sent.half_spaces = floor_at(-1e-3);
  sent.half_spaces.count = kMaxHalfSpaces;
  for (std::size_t i = 0; i < kMaxHalfSpaces; ++i) {
    const double angle = 0.3 * static_cast<double>(i);
    sent.half_spaces.rows[i] = {Vector3d(std::cos(angle), std::sin(angle), 0.0), Vector3d(angle, 1.0, 2.0), -angle};
  }
  sent.half_spaces.X_WB = Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(0.5, Vector3d::UnitY());
  sent.half_spaces.p_HR = Vector3d(0.1, 0.2, 0.3);
  sent.half_spaces.damping = 2.0;
  sent.half_spaces.expiry = milliseconds(50);
  CommandHeader header;
  GloveCommand received;
  ASSERT_EQ(decode(encode(CommandHeader{1, 7, 9}, sent), header, received), MessageError::kNone);
  const HalfSpaces& got = received.half_spaces;
  EXPECT_TRUE(got.X_WB.isApprox(sent.half_spaces.X_WB, 1e-15));
  EXPECT_EQ(got.p_HR, sent.half_spaces.p_HR);
  ASSERT_EQ(got.count, kMaxHalfSpaces);
  for (std::size_t i = 0; i < kMaxHalfSpaces; ++i) {
    EXPECT_TRUE(got.rows[i].n_W.isApprox(sent.half_spaces.rows[i].n_W, 1e-15));
    EXPECT_EQ(got.rows[i].r_W, sent.half_spaces.rows[i].r_W);
    EXPECT_EQ(got.rows[i].bound, sent.half_spaces.rows[i].bound);
  }
  EXPECT_EQ(got.stiffness, 1000.0);
  EXPECT_EQ(got.rotational_stiffness, 5.0);
  EXPECT_EQ(got.damping, 2.0);
  EXPECT_EQ(got.max_force, 20.0);
  EXPECT_EQ(got.max_torque, 1.0);
  EXPECT_EQ(got.expiry, milliseconds(50));
  GloveCommand bad = sent;
  bad.half_spaces.rows[7].n_W *= 1.1;
  EXPECT_EQ(decode(encode(CommandHeader{1, 7, 9}, bad), header, received), MessageError::kOutOfRange);
  bad = sent;
  bad.half_spaces.max_torque = -1.0;
  EXPECT_EQ(decode(encode(CommandHeader{1, 7, 9}, bad), header, received), MessageError::kOutOfRange);
}

}  // namespace
}  // namespace glissade::devices

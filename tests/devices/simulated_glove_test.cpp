#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>

#include "safe_command.h"

namespace glissade::devices {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kTick(1);

geometry::PoseTrajectory hold(const Vector3d& p_WH) {
  return geometry::PoseTrajectory({{seconds(0), Isometry3d(Translation3d(p_WH))}});
}

geometry::PoseTrajectory line(const Vector3d& from_WH, const Vector3d& to_WH, milliseconds duration) {
  return geometry::PoseTrajectory(
      {{milliseconds(0), Isometry3d(Translation3d(from_WH))}, {duration, Isometry3d(Translation3d(to_WH))}});
}

TEST(SimulatedGlove, StartsAtRestAtTheScriptsFirstPose) {
  SimulatedGlove glove(hold({0.1, 0.2, 0.3}));
  EXPECT_EQ(glove.state().sequence, 0);
  const GloveState state = glove.step(kTick, {});
  EXPECT_EQ(state.sequence, 1);
  EXPECT_EQ(state.time, kTick);
  EXPECT_EQ(state.X_WH.translation(), Vector3d(0.1, 0.2, 0.3));
  EXPECT_TRUE(state.v_WH.isZero(0.0));
}

// The wearer's damper acts against the script's own velocity, so only the arm's friction holds the hand back.
TEST(SimulatedGlove, InFreeSpaceLagsByTheArmsFrictionOnly) {
  constexpr double kSpeed = 0.2;
  const SimulatedGloveParameters parameters;
  SimulatedGlove glove(line({0, 0, 0}, {2 * kSpeed, 0, 0}, seconds(2)));
  for (int i = 0; i < 1500; ++i)
    glove.step(kTick, {});
  const double lag = kSpeed * 1.5 - glove.state().X_WH.translation().x();
  EXPECT_NEAR(lag, parameters.arm_damping * kSpeed / parameters.wearer_stiffness, 1e-6);
  EXPECT_NEAR(glove.state().v_WH.x(), kSpeed, 1e-6);
}

TEST(SimulatedGlove, StopsWhereTheWearerWaitsAndGoesOnFromThere) {
  constexpr double kSpeed = 0.2;
  SimulatedGlove glove(line({0, 0, 0}, {2 * kSpeed, 0, 0}, seconds(2)));
  for (int i = 0; i < 500; ++i)
    glove.step(kTick, {});
  for (int i = 0; i < 500; ++i)
    glove.step(kTick, {}, 0.0);
  EXPECT_EQ(glove.script_time(), milliseconds(500));
  EXPECT_EQ(glove.state().time, seconds(1)) << "its clock goes on";
  EXPECT_NEAR(glove.state().X_WH.translation().x(), 0.5 * kSpeed, 1e-4);
  EXPECT_NEAR(glove.state().v_WH.x(), 0.0, 1e-4);
  for (int i = 0; i < 500; ++i)
    glove.step(kTick, {}, 0.5);
  EXPECT_EQ(glove.script_time(), milliseconds(750));
  EXPECT_NEAR(glove.state().v_WH.x(), 0.5 * kSpeed, 1e-4);
}

TEST(SimulatedGlove, TurnsWithTheScript) {
  const Isometry3d X_end(AngleAxisd(1.2, Vector3d(1, 2, -1).normalized()));
  SimulatedGlove glove(geometry::PoseTrajectory({{seconds(0), Isometry3d::Identity()}, {seconds(1), X_end}}));
  for (int i = 0; i < 900; ++i)
    glove.step(kTick, {});
  const Vector3d w_script = 1.2 * Vector3d(1, 2, -1).normalized();
  EXPECT_TRUE(glove.state().w_WH.isApprox(w_script, 1e-6));
  for (int i = 0; i < 1100; ++i)
    glove.step(kTick, {});
  EXPECT_TRUE(glove.state().X_WH.isApprox(X_end, 1e-6));
}

TEST(SimulatedGlove, YieldsToForceAndTorqueByItsCompliance) {
  const SimulatedGloveParameters parameters;
  SimulatedGlove glove(hold({0, 0, 0}), parameters);
  GloveCommand command;
  command.f_H_W = Vector3d(3, -4, 5);
  command.t_H_W = Vector3d(0.2, 0.1, -0.3);
  const SafeCommand safe = test_support::safe_command(command, glove.descriptor());
  for (int i = 0; i < 3000; ++i)
    glove.step(kTick, safe);
  const GloveState& state = glove.state();
  EXPECT_TRUE(state.X_WH.translation().isApprox(command.f_H_W / parameters.wearer_stiffness, 1e-9));
  const AngleAxisd turn(state.X_WH.linear());
  EXPECT_TRUE(
      Vector3d(turn.angle() * turn.axis()).isApprox(command.t_H_W / parameters.wearer_rotational_stiffness, 1e-9));
  EXPECT_LT(state.v_WH.norm() + state.w_WH.norm(), 1e-9);
}

// A wall at x = 0 of stiffness K, rendered at 1 kHz from the last state; the wearer presses on to x = 20 mm.
TEST(SimulatedGlove, RestsAgainstAVirtualWallWhereTheForcesBalance) {
  constexpr double kWall = 1000.0;
  constexpr double kAim = 0.02;
  const SimulatedGloveParameters parameters;
  SimulatedGlove glove(line({-0.03, 0, 0}, {kAim, 0, 0}, milliseconds(500)), parameters);
  SafetyEnvelope envelope(glove.descriptor());
  SafeCommand safe;
  double deepest = 0.0;
  bool has_touched = false;
  bool has_left = false;
  for (int i = 0; i < 3000; ++i) {
    const double x = glove.step(kTick, safe).X_WH.translation().x();
    deepest = std::max(deepest, x);
    has_left = has_left || (has_touched && x <= 0.0);
    has_touched = has_touched || x > 0.0;
    GloveCommand command;
    command.f_H_W.x() = x > 0.0 ? -kWall * x : 0.0;
    safe = test_support::limited(envelope, command, glove.state());
  }
  const double balance = kAim * parameters.wearer_stiffness / (parameters.wearer_stiffness + kWall);
  EXPECT_NEAR(glove.state().X_WH.translation().x(), balance, 1e-9);
  EXPECT_LT(glove.state().v_WH.norm(), 1e-8);
  EXPECT_FALSE(has_left);
  EXPECT_LT(deepest, 1.5 * balance);
}

// The stiffest wall of the descriptor must not shake the hand either.
TEST(SimulatedGlove, IsStableAtTheDescriptorsStiffness) {
  const double wall = simulated_glove_descriptor().max_stiffness;
  SimulatedGlove glove(line({-0.01, 0, 0}, {0.02, 0, 0}, milliseconds(300)));
  SafetyEnvelope envelope(glove.descriptor());
  SafeCommand safe;
  for (int i = 0; i < 3000; ++i) {
    const double x = glove.step(kTick, safe).X_WH.translation().x();
    GloveCommand command;
    command.f_H_W.x() = x > 0.0 ? -wall * x : 0.0;
    safe = test_support::limited(envelope, command, glove.state());
  }
  EXPECT_LT(glove.state().v_WH.norm(), 1e-8);
}

TEST(SimulatedGlove, FingersYieldWithinTheirLimits) {
  SimulatedGloveParameters parameters;
  parameters.grasp_posture.fill(0.1);
  SimulatedGlove glove(hold({0, 0, 0}), parameters);
  GloveCommand command;
  command.joint_torques[4] = 0.2;
  command.joint_torques[5] = -0.4;
  const SafeCommand safe = test_support::safe_command(command, glove.descriptor());
  for (int i = 0; i < 1000; ++i)
    glove.step(kTick, safe);
  EXPECT_NEAR(glove.state().joint_angles[4], 0.1 + 0.2 / parameters.finger_stiffness, 1e-6);
  EXPECT_EQ(glove.state().joint_angles[5], glove.descriptor().joint_lower[5]);
  EXPECT_NEAR(glove.state().joint_angles[6], 0.1, 1e-12);
}

TEST(SimulatedGlove, FingersFollowTheGrip) {
  SimulatedGloveParameters parameters{.starts_closed = false, .grip_changes = {milliseconds(1000)}};
  parameters.open_posture.emplace().fill(0.1);
  parameters.grasp_posture.fill(0.3);
  SimulatedGlove glove(hold({0, 0, 0}), parameters);
  const auto angle = [&](int ticks) {
    for (int i = 0; i < ticks; ++i)
      glove.step(kTick, {});
    return glove.state().joint_angles[4];
  };
  EXPECT_EQ(angle(0), 0.1);
  EXPECT_NEAR(angle(1000), 0.1, 1e-12) << "it is still open";
  EXPECT_NEAR(angle(50), 0.3 - 0.2 / std::exp(1.0), 0.004) << "after the time constant";
  EXPECT_NEAR(angle(1000), 0.3, 1e-6);
}

TEST(SimulatedGlove, FingersFollowTheirOwnScriptInsteadOfTheGrip) {
  SimulatedGloveParameters parameters;
  parameters.grasp_posture.fill(0.3);
  hands::JointValues bent{};
  bent[4] = 0.8;
  parameters.fingers = {{milliseconds(100), {}}, {milliseconds(200), bent}, {milliseconds(1200), bent}};
  SimulatedGlove glove(hold({0, 0, 0}), parameters);
  EXPECT_EQ(glove.state().joint_angles[4], 0.0);
  glove.step(milliseconds(100), {});
  EXPECT_EQ(glove.state().joint_angles[4], 0.0);
  glove.step(milliseconds(600), {});
  EXPECT_NEAR(glove.state().joint_angles[4], 0.8, 1e-4);
  EXPECT_EQ(glove.state().joint_angles[5], 0.0);
}

TEST(SimulatedGlove, AnglesAreLinearBetweenTimesAndConstantBeyond) {
  hands::JointValues bent{};
  bent[2] = 0.4;
  const std::vector<TimedAngles> timed{{milliseconds(10), {}}, {milliseconds(20), bent}};
  EXPECT_EQ(angles_at(timed, milliseconds(0))[2], 0.0);
  EXPECT_DOUBLE_EQ(angles_at(timed, milliseconds(15))[2], 0.2);
  EXPECT_EQ(angles_at(timed, milliseconds(20))[2], 0.4);
  EXPECT_EQ(angles_at(timed, milliseconds(99))[2], 0.4);
}

TEST(SimulatedGlove, IsDeterministicAndDividesLongSteps) {
  const geometry::PoseTrajectory script = line({0, 0, 0}, {0.3, 0.1, 0}, milliseconds(200));
  SimulatedGlove one(script);
  SimulatedGlove two(script);
  GloveCommand command;
  command.f_H_W = Vector3d(1, 2, 3);
  command.t_H_W = Vector3d(0.1, 0, 0.2);
  const SafeCommand safe = test_support::safe_command(command, one.descriptor());
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 3; ++j)
      one.step(kTick, safe);
    two.step(3 * kTick, safe);
    ASSERT_EQ(one.state().X_WH.matrix(), two.state().X_WH.matrix());
    ASSERT_EQ(one.state().v_WH, two.state().v_WH);
    ASSERT_EQ(one.state().time, two.state().time);
  }
}

TEST(SimulatedGlove, LongStepExertsItsCommandOnlyBriefly) {
  GloveCommand command;
  command.f_H_W = Vector3d(10, 0, 0);
  command.joint_torques.fill(-0.3);
  SimulatedGloveParameters parameters;
  parameters.grasp_posture.fill(0.5);
  SimulatedGlove late(hold({0, 0, 0}), parameters);
  SimulatedGlove renewed(hold({0, 0, 0}), parameters);
  const SafeCommand safe = test_support::safe_command(command, late.descriptor());
  late.step(60 * kTick, safe);
  for (int i = 0; i < 60; ++i)
    renewed.step(kTick, safe);
  EXPECT_LT(renewed.state().joint_angles[4], 0.15) << "the torque takes the finger 0.6 rad from the wearer's aim";
  EXPECT_GT(late.state().joint_angles[4], 0.45) << "after ten of the 60 ms there is no torque any more";
  EXPECT_GT(renewed.state().X_WH.translation().x(), 3 * late.state().X_WH.translation().x());
}

// An arm without a wearer keeps the speed that the command has given it.
TEST(SimulatedGlove, ExertsALateCommandForTenPeriods) {
  GloveCommand command;
  command.f_H_W = Vector3d(8, 0, 0);
  SimulatedGloveParameters parameters;
  parameters.arm_damping = parameters.wearer_damping = 0.0;
  parameters.wearer_stiffness = 1e-6;
  const auto speed_after = [&](int ticks) {
    SimulatedGlove glove(hold({0, 0, 0}), parameters);
    return glove.step(ticks * kTick, test_support::safe_command(command, glove.descriptor())).v_WH.x();
  };
  EXPECT_NEAR(speed_after(3), 3e-3 * 8 / 0.8, 1e-9);
  EXPECT_NEAR(speed_after(10), 6.5e-3 * 8 / 0.8, 1e-9) << "seven periods fade: half of them";
  EXPECT_NEAR(speed_after(60), speed_after(10), 1e-9);
}

TEST(SimulatedGlove, RefusesParametersByName) {
  const auto complaint = [](const SimulatedGloveParameters& parameters) -> std::string {
    try {
      const SimulatedGlove glove(hold({0, 0, 0}), parameters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({}), "");
  EXPECT_THAT(complaint({.mass = 0.0}), testing::HasSubstr("mass"));
  EXPECT_THAT(complaint({.wearer_stiffness = 1e9}), testing::HasSubstr("1 ms"));
  EXPECT_THAT(complaint({.wearer_rotational_damping = std::numeric_limits<double>::quiet_NaN()}),
              testing::HasSubstr("wearer_rotational_damping"));
  EXPECT_THAT(complaint({.fingers = {{milliseconds(5), {}}, {milliseconds(5), {}}}}), testing::HasSubstr("must rise"));
}

}  // namespace
}  // namespace glissade::devices

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <glissade/devices/safety_limits.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::devices {
namespace {

using Eigen::Vector3d;

const DeviceDescriptor kDevice = simulated_glove_descriptor();  // 20 N, 1 Nm, 0.5 Nm a joint

bool is_zero(const GloveCommand& command) {
  return command.f_H_W.isZero(0.0) && command.t_H_W.isZero(0.0) && command.joint_torques == JointValues{};
}

TEST(LimitCommand, LeavesACommandWithinTheLimitsAlone) {
  GloveCommand command;
  command.sequence = 3;
  command.state_sequence = 2;
  command.f_H_W = Vector3d(0, -20.0, 0);
  command.t_H_W = Vector3d(0.6, 0, 0.8);
  command.joint_torques[7] = -0.5;
  const LimitedCommand limited = limit_command(command, kDevice);
  EXPECT_FALSE(limited.reasons.any());
  EXPECT_EQ(limited.command.f_H_W, command.f_H_W);
  EXPECT_EQ(limited.command.t_H_W, command.t_H_W);
  EXPECT_EQ(limited.command.joint_torques, command.joint_torques);
  EXPECT_EQ(limited.command.sequence, 3);
  EXPECT_EQ(limited.command.state_sequence, 2);
}

TEST(LimitCommand, SaysWhichLimitWasMet) {
  GloveCommand command;
  command.f_H_W = Vector3d(30, 0, 40);
  const LimitedCommand limited = limit_command(command, kDevice);
  EXPECT_TRUE(limited.command.f_H_W.isApprox(Vector3d(12, 0, 16), 1e-14));
  EXPECT_TRUE(limited.reasons.force_limited);
  EXPECT_FALSE(limited.reasons.torque_limited || limited.reasons.joints_limited || limited.reasons.not_finite);

  command = {};
  command.t_H_W = Vector3d(0, 2, 0);
  EXPECT_TRUE(limit_command(command, kDevice).reasons.torque_limited);
  command = {};
  command.joint_torques[3] = -0.6;
  EXPECT_TRUE(limit_command(command, kDevice).reasons.joints_limited);
  EXPECT_EQ(limit_command(command, kDevice).command.joint_torques[3], -0.5);
}

TEST(LimitCommand, NeverExceedsALimitAndKeepsTheDirection) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-320.0, 308.0);
  const auto random_vector = [&] {
    Vector3d v(normal(random), normal(random), normal(random));
    v *= std::pow(10.0, exponent(random)) / v.lpNorm<Eigen::Infinity>();
    return v;
  };
  for (int i = 0; i < 20000; ++i) {
    GloveCommand command;
    command.f_H_W = random_vector();
    command.t_H_W = random_vector();
    for (double& torque : command.joint_torques)
      torque = normal(random);
    const GloveCommand safe = limit_command(command, kDevice).command;
    ASSERT_LE(safe.f_H_W.norm(), kDevice.max_force) << command.f_H_W.transpose();
    ASSERT_LE(safe.t_H_W.norm(), kDevice.max_torque) << command.t_H_W.transpose();
    for (const double torque : safe.joint_torques)
      ASSERT_LE(std::abs(torque), kDevice.max_joint_torque);
    // Directions are compared with the largest component scaled to 1, where nothing over- or underflows.
    const auto direction = [](const Vector3d& v) { return Vector3d(v / v.lpNorm<Eigen::Infinity>()); };
    ASSERT_TRUE(direction(safe.f_H_W).isApprox(direction(command.f_H_W), 1e-12)) << command.f_H_W.transpose();
    if (command.f_H_W.stableNorm() > kDevice.max_force) {
      ASSERT_NEAR(safe.f_H_W.norm(), kDevice.max_force, 1e-12);
    }
  }
}

TEST(LimitCommand, AnyNumberThatIsNotFiniteMeansNoForceAtAll) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (int place = 0; place < 6 + kGloveJoints; ++place) {
      GloveCommand command;
      command.f_H_W = Vector3d(1, 2, 3);
      command.t_H_W = Vector3d(0.1, 0.2, 0.3);
      command.joint_torques.fill(0.1);
      if (place < 3) {
        command.f_H_W[place] = bad;
      } else if (place < 6) {
        command.t_H_W[place - 3] = bad;
      } else {
        command.joint_torques[static_cast<std::size_t>(place - 6)] = bad;
      }
      const LimitedCommand limited = limit_command(command, kDevice);
      EXPECT_TRUE(is_zero(limited.command)) << place;
      EXPECT_TRUE(limited.reasons.not_finite) << place;
    }
  }
}

TEST(LimitCommand, ALimitThatIsNoNumberAllowsNothing) {
  DeviceDescriptor broken = kDevice;
  broken.max_force = std::numeric_limits<double>::quiet_NaN();
  broken.max_torque = -1.0;
  broken.max_joint_torque = 0.0;
  GloveCommand command;
  command.f_H_W = Vector3d(1e-300, 0, 0);
  command.t_H_W = Vector3d(1, 0, 0);
  command.joint_torques.fill(1e-3);
  EXPECT_TRUE(is_zero(limit_command(command, broken).command));
}

}  // namespace
}  // namespace glissade::devices

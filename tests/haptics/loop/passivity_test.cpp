// A device, a link with delay and a virtual wall: the coupling stays passive, and the wall never feeds an oscillation.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/coupling.h>

#include "delayed_wall.h"
#include "random_numbers.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test_support::DelayedWall;

TEST(PassiveStiffness, IsTheStabilityLimitOfAHeavyDevice) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  for (const milliseconds delay :
       {milliseconds(0), milliseconds(1), milliseconds(5), milliseconds(20), milliseconds(50)}) {
    const double low = test_support::stiffness_that_grows(device.damping, delay);
    const double limit = passive_stiffness(device, milliseconds(1), delay).translational;
    EXPECT_NEAR(limit / low, 1.0, 0.1) << delay.count() << " ms of delay: " << limit << " and " << low << " N/m";
  }
}

TEST(PassiveStiffness, IsLimitedByFrictionForCoarsePositions) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.friction = 0.05;
  device.resolution = 1e-4;
  EXPECT_EQ(passive_stiffness(device, milliseconds(1), nanoseconds(0)).translational, 1000.0);
}

// As if it had the least damping with which its 4000 N/m are passive at 1 kHz: 2 N s/m.
TEST(PassiveStiffness, FallsWithLinkDelayIfDampingIsUnknown) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.damping = 0.0;
  const auto stiffness = [&](milliseconds delay) {
    return coupling_for(device, {1e5, 1.0}, milliseconds(1), delay).stiffness.translational;
  };
  EXPECT_DOUBLE_EQ(stiffness(milliseconds(0)), 4000.0);
  EXPECT_DOUBLE_EQ(stiffness(milliseconds(50)), 2.0 / 50.5e-3);
}

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// diag(translational, rotational) at a point, as felt by the device at a distance from it.
Matrix6d at_device(const Vector3d& lever, double translational, double rotational) {
  Eigen::Matrix3d across;  // across · w = w × lever
  across << 0.0, lever.z(), -lever.y(), -lever.z(), 0.0, lever.x(), lever.y(), -lever.x(), 0.0;
  Matrix6d motion = Matrix6d::Identity();
  motion.topRightCorner<3, 3>() = across;
  Eigen::Vector<double, 6> diagonal;
  diagonal << Vector3d::Constant(translational), Vector3d::Constant(rotational);
  return motion.transpose() * diagonal.asDiagonal() * motion;
}

// By the eigenvalues of the whole matrix, relative to the damping of the device.
TEST(PassiveStiffness, IsPassiveAndMaximalForAPartAtADistance) {
  test_support::RandomNumbers random(5);
  int lowered = 0;
  for (int i = 0; i < 2000; ++i) {
    devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    device.damping = std::exp(random.uniform(-1.0, 3.0));
    device.rotational_damping = std::exp(random.uniform(-5.0, 0.0));
    device.max_stiffness = device.max_rotational_stiffness = 1e9;
    const double distance = random.uniform(0.0, 0.4);
    const Vector3d lever = distance * random.direction();
    const auto delay = std::chrono::microseconds(static_cast<int>(random.uniform(0.0, 20e3)));
    contact::CouplingStiffness wanted{};
    wanted.translational = std::exp(random.uniform(3.0, 8.0));
    wanted.rotational = std::exp(random.uniform(-4.0, 3.0));
    const double lag = 0.5e-3 + std::chrono::duration<double>(delay).count();
    const Coupling coupling = coupling_within_limits(device, wanted, milliseconds(1), delay, lever.norm());
    const Matrix6d damping = at_device(Vector3d::Zero(), device.damping, device.rotational_damping);
    const auto greatest_share = [&](const Matrix6d& needed) {
      return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d>(needed, damping).eigenvalues().maxCoeff();
    };
    const auto& [K, B] = coupling;
    const Matrix6d for_spring = lag * at_device(lever, K.translational, K.rotational);
    ASSERT_LE(greatest_share(for_spring + at_device(lever, B.translational, B.rotational)), 1.0 + 1e-9) << i;
    const Coupling near = coupling_within_limits(device, wanted, milliseconds(1), delay);
    if (K.translational > (1.0 - 1e-9) * near.stiffness.translational) continue;
    ++lowered;
    ASSERT_NEAR(greatest_share(for_spring), 1.0, 1e-9) << i;
    ASSERT_NEAR(K.translational / K.rotational, near.stiffness.translational / near.stiffness.rotational,
                1e-9 * K.translational / K.rotational)
        << i;
  }
  EXPECT_GT(lowered, 500);
}

/// A wearer, as stiff and damped as a relaxed arm, wants to be 20 mm deep in the wall. Returns the greatest change of
/// the force in the last second of eight.
double unrest(DelayedWall& wall) {
  double least = 1e9;
  double greatest = -1e9;
  for (int i = 0; i < 8000; ++i) {
    wall.step(-400.0 * (wall.z() + 0.02));
    if (i < 7000) continue;
    least = std::min(least, wall.force());
    greatest = std::max(greatest, wall.force());
  }
  return greatest - least;
}

TEST(DelayedWall, DelaySoftensTheWallWithoutOscillation) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  for (const milliseconds one_way :
       {milliseconds(0), milliseconds(1), milliseconds(5), milliseconds(25), milliseconds(50)}) {
    DelayedWall wall(device, 0.8, 1000.0, one_way, 20.0);
    EXPECT_LT(unrest(wall), 0.05) << one_way.count() << " ms";
    const double limit = wall.kernel().present_coupling(0).stiffness.translational;
    EXPECT_NEAR(wall.force() / -wall.z(), limit, 0.02 * limit) << one_way.count() << " ms";
    const double passive = std::min(1000.0, 2.0 / (0.5e-3 + 2e-3 * static_cast<double>(one_way.count())));
    EXPECT_LE(limit, 1.02 * passive);
    EXPECT_GE(limit, 0.92 * passive) << "the part is 5 mm from the hand";
  }
}

TEST(DelayedWall, UnknownDampingCausesNoOscillation) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  const double untold = std::exchange(device.damping, 0.0);
  for (const milliseconds one_way : {milliseconds(0), milliseconds(5), milliseconds(25)}) {
    DelayedWall wall(device, 0.8, 1000.0, one_way, untold + 20.0);
    EXPECT_LT(unrest(wall), 0.05) << one_way.count() << " ms";
  }
}

/// A hand presses with `push` N, then `interrupt` happens: the force seconds later, and by how much it falls within a
/// second. It may still rise: a calm contact gets back slowly what the refill did not give.
struct Afterwards {
  double force;
  double unrest;
};

Afterwards after(double push, const std::function<void(DelayedWall& wall)>& interrupt) {
  DelayedWall wall(devices::simulated_glove_descriptor(), 0.8, 1000.0, milliseconds(0), 20.0);
  const double target = -push / 400.0 - push / 1000.0;
  const auto lead = [&](int ms) {
    for (int i = 0; i < ms; ++i)
      wall.step(-400.0 * (wall.z() - target));
  };
  lead(3000);
  interrupt(wall);
  lead(3000);
  const double force = wall.force();
  double greatest = force;
  double fall = 0.0;
  for (int i = 0; i < 1000; ++i) {
    lead(1);
    greatest = std::max(greatest, wall.force());
    fall = std::max(fall, greatest - wall.force());
  }
  return {force, fall};
}

TEST(DelayedWall, ForceIsRestoredAndSteadyAfterAnInterruption) {
  for (const double push : {2.0, 5.0, 10.0, 15.0, 19.0}) {
    for (const milliseconds time : {milliseconds(20), milliseconds(100), milliseconds(800)}) {
      SCOPED_TRACE(testing::Message() << push << " N, " << time.count() << " ms");
      const Afterwards silence = after(push, [&](DelayedWall& wall) { wall.fall_silent(time); });
      EXPECT_NEAR(silence.force, push, (push > 15.0 ? 0.2 : 0.02) * push) << "the refill has an end";
      EXPECT_LT(silence.unrest, 0.05);
      const Afterwards halt = after(push, [&](DelayedWall& wall) { wall.halt(time); });
      EXPECT_NEAR(halt.force, push, 0.05 * push);
      EXPECT_LT(halt.unrest, 0.05);
    }
  }
}

/// Far beyond the depth at which the device gives its all, and back.
TEST(DelayedWall, ForceIsSteadyAfterRetreatFromDeepContact) {
  for (const auto& [deep, back] :
       {std::pair(0.13, 0.11), std::pair(0.13, 0.09), std::pair(0.09, 0.06), std::pair(0.23, 0.13)}) {
    DelayedWall wall(devices::simulated_glove_descriptor(), 0.8, 1000.0, milliseconds(0), 20.0);
    double least = 1e9;
    double greatest = -1e9;
    for (int i = 0; i < 9000; ++i) {
      const double in = std::clamp((i - 1000) / 1000.0, 0.0, 1.0);
      const double out = std::clamp((i - 4000) / 500.0, 0.0, 1.0);
      wall.step(-400.0 * (wall.z() + in * deep + out * (back - deep)));
      if (i < 7000) continue;
      least = std::min(least, wall.force());
      greatest = std::max(greatest, wall.force());
    }
    EXPECT_LT(greatest - least, 0.05) << deep << " to " << back;
    EXPECT_GT(least, 10.0) << deep << " to " << back;
  }
}

// A thousand settings: scripts/bench --only passivity.
TEST(DelayedWall, NeverGivesBackMoreEnergyThanTheHandPutIn) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const test_support::WallEnergies energies = test_support::random_wall(seed);
    EXPECT_GE(energies.least_J, 0.0) << "seed " << seed;
    EXPECT_LE(energies.given_J, 0.1 + 1.0 + 0.3 * 3.0) << "with the refill of three seconds, seed " << seed;
  }
}

// Its damping is told four times too great, so the coupling alone would let it oscillate.
TEST(DelayedWall, EnergyIsBoundedForALateDeviceReportingTooMuchDamping) {
  for (const milliseconds delay : {milliseconds(5), milliseconds(10), milliseconds(20), milliseconds(40)}) {
    devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    device.delay = delay;
    device.damping = 20.0;
    DelayedWall wall(device, 0.4, 4000.0, milliseconds(0), -15.0);
    double work = 0.0;
    for (int ms = 1; ms <= 20'000; ++ms) {
      const double before = wall.z();
      wall.step(-8.0);
      work += wall.force() * (wall.z() - before);
      ASSERT_LE(work, 0.1 + 1.0 + 0.3e-3 * ms + 0.4) << delay.count() << " ms";
    }
  }
}

}  // namespace
}  // namespace glissade::haptics

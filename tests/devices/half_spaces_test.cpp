/// The wrench of half-spaces that a device holds by itself.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <glissade/devices/glove_device.h>

#include "allocation_counter.h"
#include "half_spaces/least_distance.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using geometry::Vector6d;

constexpr double kStiffness = 1000.0;          // N/m
constexpr double kRotationalStiffness = 10.0;  // Nm/rad
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// About the hand root, without a bound of the force.
HalfSpaces half_spaces(std::initializer_list<HalfSpace> rows) {
  HalfSpaces result;
  result.count = rows.size();
  std::copy(rows.begin(), rows.end(), result.rows.begin());
  result.stiffness = kStiffness;
  result.rotational_stiffness = kRotationalStiffness;
  result.max_force = result.max_torque = kUnbounded;
  return result;
}

Eigen::Isometry3d hand_at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

const HalfSpace kFloor{Vector3d::UnitZ(), Vector3d::Zero(), 0.0};

TEST(HalfSpaceWrench, PushesBackWhereTheHandIsTooDeep) {
  const HalfSpaces floor = half_spaces({kFloor});
  EXPECT_TRUE(half_space_wrench(floor, hand_at(0.1, 0.0, 1e-3)).f_H_W.isZero(0.0));
  const HandWrench pressed = half_space_wrench(floor, hand_at(0.1, 0.0, -2e-3));
  EXPECT_TRUE(pressed.f_H_W.isApprox(Vector3d(0.0, 0.0, 2.0), 1e-12)) << "2 mm at 1000 N/m";
  EXPECT_TRUE(pressed.t_H_W.isZero(1e-12));
}

// A contact beside the reference point yields by rotation, too: two springs in series.
TEST(HalfSpaceWrench, OfAContactBesideTheHandTurnsIt) {
  const double arm = 0.05;
  const HalfSpaces floor = half_spaces({{Vector3d::UnitZ(), Vector3d(arm, 0.0, 0.0), 0.0}});
  const double force = 2e-3 / (1.0 / kStiffness + arm * arm / kRotationalStiffness);
  const HandWrench pressed = half_space_wrench(floor, hand_at(0.0, 0.0, -2e-3));
  EXPECT_TRUE(pressed.f_H_W.isApprox(Vector3d(0.0, 0.0, force), 1e-12));
  EXPECT_TRUE(pressed.t_H_W.isApprox(Vector3d(0.0, -arm * force, 0.0), 1e-12));
}

TEST(HalfSpaceWrench, IsAboutTheHandRootWhereverTheReferencePointIs) {
  HalfSpaces floor = half_spaces({kFloor});
  floor.p_HR = Vector3d(0.1, 0.0, 0.0);
  const HandWrench pressed = half_space_wrench(floor, hand_at(0.0, 0.0, -2e-3));
  EXPECT_TRUE(pressed.t_H_W.isApprox(Vector3d(0.0, -0.2, 0.0), 1e-12));
}

// Springs at each contact would add up to four times the stiffness, and shake the device.
TEST(HalfSpaceWrench, OfAFaceIsNoStifferThanOfOnePoint) {
  HalfSpaces face = half_spaces({});
  for (const double x : {-0.05, 0.05}) {
    for (const double y : {-0.05, 0.05})
      face.rows[face.count++] = {Vector3d::UnitZ(), Vector3d(x, y, 0.0), 0.0};
  }
  EXPECT_TRUE(half_space_wrench(face, hand_at(0.0, 0.0, -2e-3)).f_H_W.isApprox(Vector3d(0.0, 0.0, 2.0), 1e-9));
}

TEST(HalfSpaceWrench, InAWedgeLeadsToItsEdge) {
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  const HalfSpaces wedge =
      half_spaces({{Vector3d(s, 0.0, c), Vector3d::Zero(), 0.0}, {Vector3d(-s, 0.0, c), Vector3d::Zero(), 0.0}});
  const Vector3d p(1e-3, 0.3, -4e-3);
  const Vector3d to_edge(-p.x(), 0.0, -p.z());
  EXPECT_TRUE(
      half_space_wrench(wedge, Eigen::Isometry3d(Eigen::Translation3d(p))).f_H_W.isApprox(kStiffness * to_edge, 1e-9));
}

TEST(HalfSpaceWrench, OfContradictionsIsZero) {
  const HalfSpaces vice =
      half_spaces({{Vector3d::UnitX(), Vector3d::Zero(), 1e-3}, {-Vector3d::UnitX(), Vector3d::Zero(), 1e-3}});
  EXPECT_TRUE(half_space_wrench(vice, hand_at(0.0, 0.0, 0.0)).f_H_W.isZero(0.0));
  EXPECT_EQ(stored_energy(vice, hand_at(0.0, 0.0, 0.0)), 0.0);
}

TEST(HalfSpaceWrench, NeverExceedsForceAndTorqueOfTheDevice) {
  HalfSpaces floor = half_spaces({kFloor});
  floor.p_HR = Vector3d(0.1, 0.0, 0.0);
  floor.max_force = 5.0;
  floor.max_torque = 0.2;
  const HandWrench pressed = half_space_wrench(floor, hand_at(0.0, 0.0, -1.0));
  EXPECT_NEAR(pressed.f_H_W.norm(), 5.0, 1e-12);
  EXPECT_NEAR(pressed.t_H_W.norm(), 0.2, 1e-12);
  floor.max_torque = 0.0;
  EXPECT_NEAR(half_space_wrench(floor, hand_at(0.0, 0.0, -1e-3)).f_H_W.z(), 1.0, 1e-12) << "the force alone";
}

TEST(HalfSpaceWrench, DampingNeverPulls) {
  HalfSpaces floor = half_spaces({kFloor});
  floor.damping = 10.0;
  const auto force = [&](double z, double v) {
    return half_space_wrench(floor, hand_at(0.0, 0.0, z), Vector3d(0.0, 0.0, v)).f_H_W.z();
  };
  EXPECT_NEAR(force(-1e-3, -0.1), 2.0, 1e-12);
  EXPECT_EQ(force(-1e-3, 1.0), 0.0) << "a hand that leaves fast";
  EXPECT_EQ(force(1e-3, -1.0), 0.0) << "and one that is not there yet";
}

TEST(HalfSpaceWrench, StoredEnergyIsTheWorkAgainstIt) {
  HalfSpaces corner = half_spaces({{Vector3d(0.6, 0.0, 0.8), Vector3d(0.04, 0.0, -0.02), -1e-3},
                                   {Vector3d(-0.6, 0.0, 0.8), Vector3d(-0.03, 0.01, -0.02), 0.0},
                                   {Vector3d(0.0, 1.0, 0.0), Vector3d(0.0, -0.05, 0.02), -2e-3}});
  corner.p_HR = Vector3d(0.02, 0.01, 0.0);
  corner.max_force = 3.0;
  const Vector3d axis = Vector3d(1.0, 2.0, -1.0).normalized();
  const auto hand = [&](double s) {
    return Eigen::Translation3d(s * Vector3d(2e-3, -4e-3, -6e-3)) * Eigen::AngleAxisd(0.1 * s, axis);
  };
  constexpr double kStep = 1e-4;
  double work = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const HandWrench wrench = half_space_wrench(corner, Eigen::Isometry3d(hand((i + 0.5) * kStep)));
    const Vector3d way = kStep * Vector3d(2e-3, -4e-3, -6e-3);
    work -= wrench.f_H_W.dot(way) + wrench.t_H_W.dot(0.1 * kStep * axis);
  }
  EXPECT_GT(work, 5e-3);
  EXPECT_NEAR(stored_energy(corner, Eigen::Isometry3d(hand(1.0))), work, 1e-6);
}

/// The shortest x with G x ≥ h: of all subsets of rows that hold with equality, the one whose x satisfies all rows and
/// whose multipliers are not negative.
std::optional<Vector6d> by_all_subsets(const Inequalities& inequalities) {
  const auto count = static_cast<unsigned>(inequalities.h.size());
  for (std::uint32_t subset = 0; subset < 1U << count; ++subset) {
    const int size = std::popcount(subset);
    if (size > 6) continue;
    Eigen::MatrixXd G(size, 6);
    Eigen::VectorXd h(size);
    for (int i = 0, row = 0; i < static_cast<int>(count); ++i) {
      if ((subset >> i & 1U) == 0) continue;
      G.row(row) = inequalities.G.row(i);
      h[row++] = inequalities.h[i];
    }
    Vector6d x = Vector6d::Zero();
    bool pushes = true;
    if (size > 0) {  // Eigen solves no empty system
      const Eigen::VectorXd multipliers = (G * G.transpose()).fullPivLu().solve(h);
      x = G.transpose() * multipliers;
      pushes = multipliers.minCoeff() >= -1e-12;
    }
    if (pushes && (inequalities.G * x - inequalities.h).minCoeff() >= -1e-9) return x;
  }
  return std::nullopt;
}

TEST(LeastDistance, IsThatOfAllSubsetsOfRows) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  int solved = 0;
  for (int scene = 0; scene < 300; ++scene) {
    Inequalities inequalities;
    const auto count = static_cast<Eigen::Index>(1 + scene % static_cast<int>(kMaxHalfSpaces));
    inequalities.G.resize(count, 6);
    inequalities.h.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j)
        inequalities.G(i, j) = normal(random);
      inequalities.h[i] = 1e-3 * (normal(random) + 0.5);
    }
    if (scene % 3 == 0 && count > 1) {  // one contact twice
      inequalities.G.row(1) = inequalities.G.row(0);
      inequalities.h[1] = inequalities.h[0];
    }
    const std::optional<Vector6d> expected = by_all_subsets(inequalities);
    const std::optional<Vector6d> found = least_distance(inequalities);
    ASSERT_TRUE(expected.has_value() || !found.has_value() || found->norm() > 0.1) << scene;
    if (!expected) continue;
    ASSERT_TRUE(found.has_value()) << scene;
    ASSERT_LE((*found - *expected).norm(), 1e-8 * std::max(1e-3, expected->norm())) << scene;
    ++solved;
  }
  EXPECT_GT(solved, 280);
}

TEST(LeastDistance, DoesNotAllocate) {
  Inequalities inequalities;
  inequalities.G = Eigen::Matrix<double, 8, 6>::Random();
  inequalities.h = Eigen::Matrix<double, 8, 1>::Random();
  const std::int64_t before = test_support::allocations_of_this_thread();
  const std::optional<Vector6d> x = least_distance(inequalities);
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
  EXPECT_TRUE(x.has_value());
}

}  // namespace
}  // namespace glissade::devices

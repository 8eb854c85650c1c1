#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/pose_trajectory.h>

#include "expect_bad_input.h"

namespace glissade::geometry {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

TimedPose row(milliseconds time, const Vector3d& p_WB, double turn_about_z = 0.0) {
  return {time, Translation3d(p_WB) * AngleAxisd(turn_about_z, Vector3d::UnitZ())};
}

void expect_rows_refused(const std::vector<TimedPose>& rows, const std::vector<std::string>& parts) {
  test_support::expect_bad_input([&] { const PoseTrajectory trajectory(rows); }, parts);
}

TEST(PoseTrajectory, MovesInAStraightLineAndTurnsEvenly) {
  const PoseTrajectory trajectory(
      {row(milliseconds(100), {0, 0, 0}), row(milliseconds(300), {1, 2, 3}, std::numbers::pi / 2)});
  const Isometry3d X_WB = trajectory.pose_at(milliseconds(150));
  EXPECT_TRUE(X_WB.translation().isApprox(Vector3d(0.25, 0.5, 0.75), 1e-15));
  EXPECT_TRUE(X_WB.linear().isApprox(AngleAxisd(std::numbers::pi / 8, Vector3d::UnitZ()).toRotationMatrix(), 1e-14));
}

TEST(PoseTrajectory, RowsKeepTheirExactPosesIfTimeIsScaled) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = AngleAxisd(0.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  X(0, 0) += 1e-9;  // a quaternion would not keep that
  const PoseTrajectory path = PoseTrajectory({{milliseconds(2), X}, row(milliseconds(4), {1, 2, 3})});
  EXPECT_EQ(path.rows()[0].X_WB.matrix(), X.matrix());
  EXPECT_EQ(path.time_scaled(milliseconds(6)).rows()[1].time, milliseconds(8));
  EXPECT_EQ(path.time_scaled(milliseconds(6)).rows()[0].X_WB.matrix(), X.matrix());
}

TEST(PoseTrajectory, PassesThroughItsRowsAndHoldsTheEnds) {
  const std::vector<TimedPose> rows{row(milliseconds(0), {1, 0, 0}), row(milliseconds(7), {2, 0, 0}, 3.0),
                                    row(milliseconds(9), {3, 0, 0}, -3.0)};
  const PoseTrajectory trajectory(rows);
  for (const TimedPose& r : rows)
    EXPECT_TRUE(trajectory.pose_at(r.time).isApprox(r.X_WB, 1e-14));
  EXPECT_TRUE(trajectory.pose_at(milliseconds(-5)).isApprox(rows.front().X_WB, 1e-14));
  EXPECT_TRUE(trajectory.pose_at(milliseconds(50)).isApprox(rows.back().X_WB, 1e-14));
  // From 3 to -3 rad the shorter way leads over π.
  EXPECT_TRUE(trajectory.pose_at(milliseconds(8))
                  .linear()
                  .isApprox(AngleAxisd(std::numbers::pi, Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST(PoseTrajectory, VelocityIsTheDerivativeOfThePose) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  std::vector<TimedPose> rows;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    const Vector3d p(normal(random), normal(random), normal(random));
    rows.push_back({milliseconds(100 * i), Translation3d(p) * q.normalized()});
  }
  const PoseTrajectory trajectory(rows);
  constexpr double kStep = 1e-6;
  for (int i = 0; i + 1 < 20; ++i) {
    const nanoseconds time = milliseconds(100 * i + 40);
    const Isometry3d before = trajectory.pose_at(time);
    const Isometry3d after = trajectory.pose_at(time + std::chrono::microseconds(1));
    const FrameVelocity velocity = trajectory.velocity_at(time);
    EXPECT_TRUE(velocity.v_WB.isApprox((after.translation() - before.translation()) / kStep, 1e-6)) << i;
    const AngleAxisd turn_W(after.linear() * before.linear().transpose());
    EXPECT_TRUE(velocity.w_WB.isApprox(turn_W.angle() / kStep * turn_W.axis(), 1e-5)) << i;
  }
  EXPECT_TRUE(trajectory.velocity_at(milliseconds(-1)).v_WB.isZero(0.0));
  EXPECT_TRUE(trajectory.velocity_at(trajectory.last_time()).w_WB.isZero(0.0));
}

TEST(PoseTrajectory, TimeScalingKeepsThePath) {
  const PoseTrajectory trajectory(
      {row(milliseconds(100), {0, 0, 0}), row(milliseconds(200), {1, 0, 0}), row(milliseconds(500), {1, 1, 0}, 1.0)});
  const PoseTrajectory slow = trajectory.time_scaled(std::chrono::seconds(4));
  EXPECT_EQ(slow.first_time(), milliseconds(100));
  EXPECT_EQ(slow.duration(), std::chrono::seconds(4));
  EXPECT_TRUE(slow.pose_at(milliseconds(1100)).isApprox(trajectory.pose_at(milliseconds(200)), 1e-14));
  EXPECT_TRUE(slow.pose_at(milliseconds(2600)).isApprox(trajectory.pose_at(milliseconds(350)), 1e-14));
  EXPECT_THROW(trajectory.time_scaled(nanoseconds(0)), std::invalid_argument);
  EXPECT_THROW(trajectory.time_scaled(nanoseconds(1)), std::invalid_argument);
}

TEST(PoseTrajectory, SingleRowIsAConstantPose) {
  const PoseTrajectory trajectory({row(milliseconds(5), {1, 2, 3}, 0.5)});
  for (const int ms : {0, 5, 10}) {
    EXPECT_TRUE(trajectory.pose_at(milliseconds(ms)).isApprox(row(milliseconds(0), {1, 2, 3}, 0.5).X_WB, 1e-15));
    EXPECT_TRUE(trajectory.velocity_at(milliseconds(ms)).v_WB.isZero(0.0));
  }
  EXPECT_EQ(trajectory.time_scaled(milliseconds(3)).duration(), nanoseconds(0));
}

TEST(PoseTrajectory, ComplaintsNameTheRow) {
  expect_rows_refused({}, {"at least one row"});
  const Vector3d p(0, 0, 0);
  expect_rows_refused({row(milliseconds(0), p), row(milliseconds(1), p), row(milliseconds(1), p)},
                      {"Row 2", "does not rise"});
  const Vector3d bad(0, std::numeric_limits<double>::quiet_NaN(), 0);
  expect_rows_refused({row(milliseconds(0), p), row(milliseconds(1), bad)}, {"Row 1", "not finite"});
  TimedPose mirrored = row(milliseconds(0), p);
  mirrored.X_WB.linear()(2, 2) = -1.0;
  expect_rows_refused({mirrored}, {"not a rotation"});
}

}  // namespace
}  // namespace glissade::geometry

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/files/pose_files.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace glissade::files {
namespace {

using test_support::expect_bad_input;
using test_support::TemporaryFolder;

std::vector<Eigen::Isometry3d> read_row(const std::string& row) {
  const TemporaryFolder folder;
  return read_poses(folder.write("poses.csv", "x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,1,0,0,0\n" + row + "\n"));
}

TEST(PosesFile, ReadsPositionAndQuaternionInTheirOrder) {
  const std::vector<Eigen::Isometry3d> poses = read_row("1,2,3,0.70710678118654757,0,0,0.70710678118654757");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_TRUE(poses[0].isApprox(Eigen::Isometry3d::Identity()));
  // A quarter turn about z carries the x axis to the y axis.
  EXPECT_TRUE((poses[1] * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1.0, 3.0, 3.0), 1e-14));
}

Eigen::Isometry3d turned(const std::string& angles) {
  const TemporaryFolder folder;
  return read_poses(folder.write("turned.csv", "x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n1,2,3," + angles + "\n"))
      .front();
}

TEST(PosesFile, AnglesAreRollPitchYawAboutFixedAxes) {
  EXPECT_EQ(turned("0,0,0").linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(turned("0,0,0").translation(), Eigen::Vector3d(1.0, 2.0, 3.0));
  // y goes to z by the roll, z to x by the pitch, x to y by the yaw.
  const Eigen::Matrix3d R = turned("90,90,90").linear();
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
  const double r = 0.3, p = -0.7, y = 2.9;
  const Eigen::Matrix3d R_x{{1.0, 0.0, 0.0}, {0.0, std::cos(r), -std::sin(r)}, {0.0, std::sin(r), std::cos(r)}};
  const Eigen::Matrix3d R_y{{std::cos(p), 0.0, std::sin(p)}, {0.0, 1.0, 0.0}, {-std::sin(p), 0.0, std::cos(p)}};
  const Eigen::Matrix3d R_z{{std::cos(y), -std::sin(y), 0.0}, {std::sin(y), std::cos(y), 0.0}, {0.0, 0.0, 1.0}};
  const auto degrees = [](double angle) { return std::to_string(angle * 57.295779513082321); };
  EXPECT_TRUE(turned(degrees(r) + "," + degrees(p) + "," + degrees(y)).linear().isApprox(R_z * R_y * R_x, 1e-7));
  EXPECT_TRUE(turned("370,-350,720").isApprox(turned("10,10,0"), 1e-14)) << "whole turns do nothing";
}

TEST(PosesFile, AWrongRowOfAnglesNamesItsOwnColumns) {
  expect_bad_input([] { turned("0,0"); }, {"turned.csv:2:", "6 columns, not 5"});
  expect_bad_input([] { turned("0,up,0"); }, {"turned.csv:2:", "pitch_deg", "'up'"});
}

TEST(PosesFile, AQuaternionSlightlyOffUnitLengthIsNormalised) {
  const Eigen::Matrix3d R = read_row("0,0,0,0.9995,0,0,0")[1].linear();
  EXPECT_TRUE((R * R.transpose()).isApprox(Eigen::Matrix3d::Identity(), 1e-15));
}

TEST(PosesFile, AQuaternionFurtherOffIsAnError) {
  expect_bad_input([] { read_row("0,0,0,0.998,0,0,0"); }, {"poses.csv:3:", "0.998 0 0 0", "length 0.998"});
  expect_bad_input([] { read_row("0,0,0,1,1,0,0"); }, {"poses.csv:3:", "1 1 0 0"});
  expect_bad_input([] { read_row("0,0,0,1e200,0,0,0"); }, {"poses.csv:3:"});
}

TEST(PosesFile, AZeroQuaternionIsAnError) {
  expect_bad_input([] { read_row("0,0,0,0,0,0,0"); }, {"poses.csv:3:", "is zero"});
}

TEST(PosesFile, APositionBeyondTheExactRangeIsAnError) {
  expect_bad_input([] { read_row("0,-2e9,0,1,0,0,0"); }, {"poses.csv:3:", "-2e+09"});
}

TEST(PosesFile, AWrongRowIsAnError) {
  expect_bad_input([] { read_row("0,0,0,1,0,0"); }, {"poses.csv:3:", "7 columns, not 6"});
  expect_bad_input([] { read_row("0,0,north,1,0,0,0"); }, {"poses.csv:3:", "z_m", "'north'"});
}

}  // namespace
}  // namespace glissade::files

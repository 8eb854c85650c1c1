#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/files/poses_file.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace glissade::apps {
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
}  // namespace glissade::apps

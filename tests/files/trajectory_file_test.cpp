#include <chrono>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/files/pose_files.h>

#include "expect_bad_input.h"

namespace glissade::files {
namespace {

using std::chrono::milliseconds;
using test_support::expect_bad_input;

std::string joined_by_commas(const std::vector<std::string>& columns) {
  std::string text;
  for (const std::string& column : columns)
    text += (text.empty() ? "" : ",") + column;
  return text;
}

geometry::PoseTrajectory parse_rows(const std::string& rows) {
  return parse_trajectory("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + rows, "path.csv");
}

TEST(TrajectoryFile, ReadsTimesAndPoses) {
  const geometry::PoseTrajectory path = parse_rows("0.5,0,0,0,1,0,0,0\n1.5,2,0,4,1,0,0,0\n");
  EXPECT_EQ(path.first_time(), milliseconds(500));
  EXPECT_EQ(path.last_time(), milliseconds(1500));
  EXPECT_TRUE(path.pose_at(milliseconds(1000)).translation().isApprox(Eigen::Vector3d(1.0, 0.0, 2.0)));
}

TEST(TrajectoryFile, AnglesMayStandForAQuaternion) {
  const std::string angles = "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg";
  const geometry::PoseTrajectory path = parse_trajectory(angles + "\n0,0,0,0,0,0,0\n1,0,0,0,0,0,90\n", "path.csv");
  const Eigen::AngleAxisd eighth_turn(std::numbers::pi / 4.0, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(path.pose_at(milliseconds(500)).linear().isApprox(eighth_turn.toRotationMatrix(), 1e-14));
}

TEST(TrajectoryFile, ATimeThatDoesNotRiseNamesItsLine) {
  for (const std::string time : {"1", "0.5", "1.0000000001"}) {
    expect_bad_input([&] { parse_rows("0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n" + time + ",0,0,0,1,0,0,0\n"); },
                     {"path.csv:4:", "t_s", time, "does not rise"});
  }
}

TEST(TrajectoryFile, TimeBeyondTheNanosecondRangeIsAnError) {
  expect_bad_input([] { parse_rows("1e300,0,0,0,1,0,0,0\n"); }, {"path.csv:2:", "t_s", "1e+300"});
}

TEST(TrajectoryFile, PosesAreValidatedAsInPosesFiles) {
  expect_bad_input([] { parse_rows("0,0,0,0,0,0,0,0\n"); }, {"path.csv:2:", "is zero"});
  expect_bad_input([] { parse_rows("0,0,0,0,1.01,0,0,0\n"); }, {"path.csv:2:", "length 1.01"});
}

TEST(TrajectoryFile, APosesFileIsNotATrajectory) {
  expect_bad_input([] { parse_trajectory("x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,1,0,0,0\n", "path.csv"); },
                   {"path.csv:1:", "t_s,x_m"});
}

/// A row of zeros below these columns.
std::string table_of(const std::vector<std::string>& columns) {
  std::string zeros = "0";
  for (std::size_t i = 1; i < columns.size(); ++i)
    zeros += ",0";
  return joined_by_commas(columns) + "\n" + zeros + "\n";
}

TEST(TrajectoryFile, TableForAnotherCommandNamesThatCommand) {
  const auto expect_told = [](const std::vector<std::string>& wanted, const std::vector<std::string>& given,
                              const std::string& command) {
    expect_bad_input([&] { parse_csv(table_of(given), "table.csv", wanted); },
                     {"table.csv:1: the header row must be " + joined_by_commas(wanted), "this is", command});
  };
  std::vector<std::string> script = trajectory_columns();
  script.emplace_back("grip");
  expect_told(trajectory_columns(), hand_trajectory_columns(), "'glissade grasp --hand-trajectory'");
  expect_told(hand_trajectory_columns(), trajectory_columns(), "'glissade slide --trajectory'");
  expect_told(trajectory_columns(), pose_columns(), "'glissade collide --poses'");
  expect_told(trajectory_columns(), script, "'glissade glove --script'");
}

}  // namespace
}  // namespace glissade::files

#include <chrono>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/files/trajectory_file.h>

#include "expect_bad_input.h"

namespace glissade::apps {
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

TEST(TrajectoryFile, AnglesMayStandForAQuaternionInEveryScript) {
  const std::string angles = "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg";
  const geometry::PoseTrajectory path = parse_trajectory(angles + "\n0,0,0,0,0,0,0\n1,0,0,0,0,0,90\n", "path.csv");
  const Eigen::AngleAxisd eighth_turn(std::numbers::pi / 4.0, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(path.pose_at(milliseconds(500)).linear().isApprox(eighth_turn.toRotationMatrix(), 1e-14));
  const HandScript closing = parse_hand_script(angles + ",grip\n0,0,0,0,0,0,0,0\n1,0,0,0,180,0,0,1\n", "grip.csv");
  EXPECT_EQ(closing.grip_changes, std::vector<std::chrono::nanoseconds>{milliseconds(1000)});
  EXPECT_TRUE(closing.X_WH.pose_at(milliseconds(1000))
                  .linear()
                  .isApprox(Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal().toDenseMatrix(), 1e-14));
  const std::string columns = joined_by_commas(with_angles(hand_trajectory_columns()));
  std::string row = "0,0,0,0,0,0,0";
  for (std::size_t joint = 0; joint < joint_columns().size(); ++joint)
    row += "," + std::to_string(joint);
  const HandScript fingers = parse_hand_script(columns + "\n" + row + "\n", "fingers.csv");
  EXPECT_EQ(fingers.fingers.front().angles[3], 3.0);
  EXPECT_EQ(fingers.fingers.front().angles.back(), 21.0);
}

TEST(TrajectoryFile, ATimeThatDoesNotRiseNamesItsLine) {
  for (const std::string time : {"1", "0.5", "1.0000000001"}) {
    expect_bad_input([&] { parse_rows("0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n" + time + ",0,0,0,1,0,0,0\n"); },
                     {"path.csv:4:", "t_s", time, "does not rise"});
  }
}

TEST(TrajectoryFile, ATimeThatNanosecondsCannotCountIsAnError) {
  expect_bad_input([] { parse_rows("1e300,0,0,0,1,0,0,0\n"); }, {"path.csv:2:", "t_s", "1e+300"});
}

TEST(TrajectoryFile, PosesFollowTheRuleForPoses) {
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

TEST(TrajectoryFile, ATableForAnotherCommandNamesThisCommand) {
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

HandScript parse_hand(const std::string& rows) {
  return parse_hand_script("t_s,x_m,y_m,z_m,qw,qx,qy,qz,grip\n" + rows, "hand.csv");
}

/// A row at rest at the origin, with the first and the last joint at these angles.
std::string hand_row(const std::string& time, const std::string& first, const std::string& last) {
  std::string row = time + ",0,0,0,1,0,0,0," + first;
  for (int joint = 1; joint + 1 < hands::kJoints; ++joint)
    row += ",0";
  return row + "," + last + "\n";
}

HandScript parse_fingers(const std::string& rows) {
  std::string header = "t_s,x_m,y_m,z_m,qw,qx,qy,qz";
  for (const std::string& column : joint_columns())
    header += "," + column;
  return parse_hand_script(header + "\n" + rows, "hand.csv");
}

TEST(HandScript, MayHaveTheJointsOfTheHand) {
  const HandScript script = parse_fingers(hand_row("0", "0.1", "-0.2") + hand_row("2", "0.3", "0.2"));
  ASSERT_EQ(script.fingers.size(), 2u);
  EXPECT_EQ(script.fingers[1].time, milliseconds(2000));
  EXPECT_EQ(script.fingers[1].angles.front(), 0.3);
  EXPECT_EQ(script.fingers[0].angles.back(), -0.2);
  EXPECT_EQ(script.time_scaled(milliseconds(500)).fingers[1].time, milliseconds(500));
  devices::SimulatedGlove glove(script.X_WH, script.with_grip({}));
  EXPECT_EQ(glove.state().joint_angles.front(), 0.1);
}

TEST(HandScript, NeedsAllJointsOrNone) {
  expect_bad_input(
      [] { parse_hand_script("t_s,x_m,y_m,z_m,qw,qx,qy,qz,thumb_roll_rad\n0,0,0,0,1,0,0,0,0\n", "hand.csv"); },
      {"hand.csv:1:", "wrist_abduction_rad"});
  expect_bad_input([] { parse_fingers(hand_row("0", "wide", "0")); }, {"hand.csv:2:", "thumb_roll_rad", "wide"});
}

TEST(HandScript, TellsWhenTheHandClosesAndOpens) {
  const HandScript script = parse_hand("0,0,0,0,1,0,0,0,0\n1,0,0,0,1,0,0,0,1\n2,0,0,0,1,0,0,0,1\n4,0,0,0,1,0,0,0,0\n");
  EXPECT_FALSE(script.starts_closed);
  EXPECT_EQ(script.grip_changes, (std::vector<std::chrono::nanoseconds>{milliseconds(1000), milliseconds(4000)}));
  const HandScript faster = script.time_scaled(milliseconds(2000));
  EXPECT_EQ(faster.grip_changes, (std::vector<std::chrono::nanoseconds>{milliseconds(500), milliseconds(2000)}));
  devices::SimulatedGlove glove(script.X_WH, script.with_grip({}));
  EXPECT_EQ(glove.state().grip, 0);
  EXPECT_EQ(glove.step(milliseconds(1000), {}).grip, 1);
  EXPECT_EQ(glove.step(milliseconds(2999), {}).grip, 1);
  EXPECT_EQ(glove.step(milliseconds(1), {}).grip, 2);
}

TEST(HandScript, IsClosedWithoutThatColumn) {
  const HandScript script = parse_hand_script("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n", "hand.csv");
  EXPECT_TRUE(script.starts_closed);
  EXPECT_TRUE(script.grip_changes.empty());
}

TEST(HandScript, AHandIsClosedOrOpen) {
  expect_bad_input([] { parse_hand("0,0,0,0,1,0,0,0,0.5\n"); }, {"hand.csv:2:", "grip", "0.5"});
}

}  // namespace
}  // namespace glissade::apps

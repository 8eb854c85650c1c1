#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/files/hand_script.h>

#include "expect_bad_input.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using test_support::expect_bad_input;

TEST(HandScript, AnglesMayStandForAQuaternion) {
  const std::string angles = "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg";
  const HandScript closing = parse_hand_script(angles + ",grip\n0,0,0,0,0,0,0,0\n1,0,0,0,180,0,0,1\n", "grip.csv");
  EXPECT_EQ(closing.grip_changes, std::vector<std::chrono::nanoseconds>{milliseconds(1000)});
  EXPECT_TRUE(closing.X_WH.pose_at(milliseconds(1000))
                  .linear()
                  .isApprox(Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal().toDenseMatrix(), 1e-14));
  const std::string columns = header_of(with_angles(hand_trajectory_columns()));
  std::string row = "0,0,0,0,0,0,0";
  for (std::size_t joint = 0; joint < joint_columns().size(); ++joint)
    row += "," + std::to_string(joint);
  const HandScript fingers = parse_hand_script(columns + "\n" + row + "\n", "fingers.csv");
  EXPECT_EQ(fingers.fingers.front().angles[3], 3.0);
  EXPECT_EQ(fingers.fingers.front().angles.back(), 21.0);
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

TEST(HandScript, HandIsClosedWithoutAGripColumn) {
  const HandScript script = parse_hand_script("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n", "hand.csv");
  EXPECT_TRUE(script.starts_closed);
  EXPECT_TRUE(script.grip_changes.empty());
}

TEST(HandScript, GripOtherThan0Or1IsRefused) {
  expect_bad_input([] { parse_hand("0,0,0,0,1,0,0,0,0.5\n"); }, {"hand.csv:2:", "grip", "0.5"});
}

}  // namespace
}  // namespace glissade::apps

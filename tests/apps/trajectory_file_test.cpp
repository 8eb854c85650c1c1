#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include <glissade/apps/files/trajectory_file.h>

#include "expect_bad_input.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using test_support::expect_bad_input;

geometry::PoseTrajectory parse_rows(const std::string& rows) {
  return parse_trajectory("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + rows, "path.csv");
}

TEST(TrajectoryFile, ReadsTimesAndPoses) {
  const geometry::PoseTrajectory path = parse_rows("0.5,0,0,0,1,0,0,0\n1.5,2,0,4,1,0,0,0\n");
  EXPECT_EQ(path.first_time(), milliseconds(500));
  EXPECT_EQ(path.last_time(), milliseconds(1500));
  EXPECT_TRUE(path.pose_at(milliseconds(1000)).translation().isApprox(Eigen::Vector3d(1.0, 0.0, 2.0)));
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

HandScript parse_hand(const std::string& rows) {
  return parse_hand_script("t_s,x_m,y_m,z_m,qw,qx,qy,qz,grip\n" + rows, "hand.csv");
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

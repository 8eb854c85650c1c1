/// A trajectory followed in its file gives the same poses as one in memory.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <glissade/apps/files/followed_trajectory.h>
#include <glissade/files/pose_files.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using test_support::expect_bad_input;

class FollowedFile : public testing::Test {
 protected:
  std::string file(const std::string& rows) {
    return folder_.write("path.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + rows);
  }

  test_support::TemporaryFolder folder_;
};

const std::string kRows =
    "0.5,0,0,0,1,0,0,0\n0.5004,0,1,0,0.6,0.8,0,0\n1.5,2,0,4,1,0,0,0\n1.7,2,0,5,0,0,1,0\n1.9,1,0,5,0,0,1,0\n";

TEST_F(FollowedFile, HasThePosesOfTheTrajectory) {
  const std::string path = file(kRows);
  const geometry::PoseTrajectory whole = read_trajectory(path);
  FollowedTrajectory followed(path);
  EXPECT_EQ(followed.first_time(), whole.first_time());
  EXPECT_EQ(followed.duration(), whole.duration());
  EXPECT_TRUE(followed.first_pose().isApprox(whole.pose_at(whole.first_time()), 0.0));
  EXPECT_TRUE(followed.last_pose().isApprox(whole.pose_at(whole.last_time()), 0.0));
  for (std::int64_t ms = 400; ms <= 2000; ++ms) {
    const Eigen::Isometry3d X_WB = followed.pose_at(milliseconds(ms));
    EXPECT_EQ(X_WB.matrix(), whole.pose_at(milliseconds(ms)).matrix()) << ms << " ms";
    EXPECT_EQ(followed.pose_at(milliseconds(ms)).matrix(), X_WB.matrix()) << ms << " ms, once more";
  }
}

TEST_F(FollowedFile, MayHaveOneRow) {
  FollowedTrajectory followed(file("3,0,0,7,1,0,0,0\n"));
  EXPECT_EQ(followed.duration(), milliseconds(0));
  EXPECT_EQ(followed.pose_at(milliseconds(5000)).translation().z(), 7.0);
}

TEST_F(FollowedFile, IsCheckedToItsEndBeforeItIsFollowed) {
  expect_bad_input([&] { FollowedTrajectory{file(kRows + "1.8,0,0,0,1,0,0,0\n")}; }, {"path.csv:7:", "does not rise"});
  expect_bad_input([&] { FollowedTrajectory{file(kRows + "2,0,0,0,1,0,0\n")}; }, {"path.csv:7:", "columns"});
  expect_bad_input([&] { FollowedTrajectory{file(kRows + "90000,0,0,0,1,0,0,0\n")}; }, {"path.csv", "a day"});
  expect_bad_input([&] { FollowedTrajectory{file("")}; }, {"path.csv:1:", "any row"});
  expect_bad_input([&] { FollowedTrajectory{folder_.path("none.csv")}; }, {"none.csv: there is no such file"});
}

TEST_F(FollowedFile, ThatBecomesShorterIsAnError) {
  std::string rows;
  for (int ms = 0; ms <= 20'000; ++ms)  // more than a buffer holds
    rows += std::to_string(1e-3 * ms) + ",0,0,0,1,0,0,0\n";
  const std::string path = file(rows);
  FollowedTrajectory followed(path);
  std::filesystem::resize_file(path, 1000);
  expect_bad_input([&] { followed.pose_at(std::chrono::seconds(20)); }, {"path.csv"});
}

}  // namespace
}  // namespace glissade::apps

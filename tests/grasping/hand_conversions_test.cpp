#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/grasping/hand_conversions.h>

#include "allocation_counter.h"
#include "expect_bad_input.h"
#include "poses.h"
#include "random_chain.h"
#include "random_numbers.h"

namespace glissade::grasping {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using hands::HandSide;
using std::numbers::pi;
using test_support::RandomNumbers;

constexpr std::uint64_t kConversionSeed = 20261128;

std::size_t joint_named(const std::string& name) {
  const auto* at = std::ranges::find(kOpenXrJointNames, name);
  EXPECT_NE(at, kOpenXrJointNames.end()) << name;
  return static_cast<std::size_t>(at - kOpenXrJointNames.begin());
}

std::size_t value_named(const std::string& name) {
  const auto* at = std::ranges::find(hands::kJointNames, name);
  EXPECT_NE(at, hands::kJointNames.end()) << name;
  return static_cast<std::size_t>(at - hands::kJointNames.begin());
}

/// Anywhere in the world, within the limits, with a straight wrist.
HandPose random_pose(RandomNumbers& random, const HandModel& hand) {
  HandPose pose;
  pose.X_WR.linear() = random.rotation();
  pose.X_WR.translation() = random.point(2.0);
  for (std::size_t i = 0; i < 20; ++i)
    pose.values[i] = random.uniform(hand.chain.values()[i].lower, hand.chain.values()[i].upper);
  return pose;
}

TEST(OpenXr, GivesBackThePoseOfEitherHand) {
  RandomNumbers random(kConversionSeed);
  for (const HandSide side : {HandSide::kLeft, HandSide::kRight}) {
    const HandModel hand = make_hand({.side = side});
    for (int run = 0; run < 500; ++run) {
      const HandPose pose = random_pose(random, hand);
      const HandPose back = from_openxr(hand, to_openxr(hand, pose));
      ASSERT_TRUE(back.X_WR.isApprox(pose.X_WR, 1e-12)) << "seed " << kConversionSeed;
      for (std::size_t i = 0; i < pose.values.size(); ++i)
        ASSERT_NEAR(back.values[i], pose.values[i], 1e-6)
            << hands::kJointNames[i] << ", seed " << kConversionSeed << ", run " << run;
    }
  }
}

// The tracked bones may be longer: only their directions count.
TEST(OpenXr, TakesTheJointsOfAHandOfOtherSize) {
  RandomNumbers random(kConversionSeed);
  const HandModel tracked = make_hand({.length_m = 0.21, .breadth_m = 0.09});
  const HandModel hand = make_hand({.length_m = 0.166, .breadth_m = 0.075});
  const HandPose pose = random_pose(random, hand);
  const HandPose back = from_openxr(hand, to_openxr(tracked, pose));
  EXPECT_TRUE(back.X_WR.isApprox(pose.X_WR, 1e-12));
  for (std::size_t i = 0; i < 13; ++i)
    EXPECT_NEAR(back.values[i], pose.values[i], 1e-6) << hands::kJointNames[i];
}

TEST(OpenXr, WristFlexionBecomesRootRotation) {
  const HandModel hand = make_hand();
  HandPose pose;
  pose.values[value_named("wrist_flexion")] = 0.5;
  const HandPose back = from_openxr(hand, to_openxr(hand, pose));
  EXPECT_EQ(back.values[value_named("wrist_flexion")], 0.0);
  EXPECT_TRUE(back.X_WR.linear().isApprox(test_support::turn(0.5, Vector3d::UnitY()).toRotationMatrix(), 1e-12));
}

// XR_EXT_hand_tracking: -z along the bone towards the tip, y out of the back of the hand, x to the right.
TEST(OpenXr, JointAxesFollowTheBonesAsInXrExtHandTracking) {
  for (const HandSide side : {HandSide::kLeft, HandSide::kRight}) {
    const HandModel hand = make_hand({.side = side});
    const OpenXrJoints joints = to_openxr(hand, {});
    for (const char* finger : {"index", "middle", "ring", "little"}) {
      const std::string name(finger);
      const std::array<std::size_t, 5> row{joint_named(name + "_metacarpal"), joint_named(name + "_proximal"),
                                           joint_named(name + "_intermediate"), joint_named(name + "_distal"),
                                           joint_named(name + "_tip")};
      for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        const Isometry3d& X_WOpenXr = joints[row[i]].X_WOpenXr;
        const Vector3d bone = (joints[row[i + 1]].X_WOpenXr.translation() - X_WOpenXr.translation()).normalized();
        EXPECT_TRUE(bone.isApprox(-X_WOpenXr.linear().col(2), 1e-6)) << kOpenXrJointNames[row[i]];
        EXPECT_TRUE(X_WOpenXr.linear().col(1).isApprox(Vector3d::UnitZ(), 1e-9)) << "out of the back";
        EXPECT_GT(joints[row[i]].radius, 0.005);
        EXPECT_LT(joints[row[i]].radius, 0.02);
      }
    }
    EXPECT_TRUE(joints[joint_named("wrist")].X_WOpenXr.linear().col(0).isApprox(-Vector3d::UnitY(), 1e-12)) << "right";
  }
}

// A thumb whose nail a runtime sees elsewhere: the direction of the bone matters more.
TEST(OpenXr, FitPrefersThumbDirectionToThumbRoll) {
  const HandModel hand = make_hand();
  HandPose pose;
  pose.values[value_named("thumb_roll")] = 0.5;
  pose.values[value_named("thumb_index_abduction")] = 0.7;
  OpenXrJoints joints = to_openxr(hand, pose);
  const std::size_t metacarpal = joint_named("thumb_metacarpal");
  joints[metacarpal].X_WOpenXr.rotate(Eigen::AngleAxisd(0.4, Vector3d::UnitZ()));  // about the bone
  const Vector3d bone = joints[metacarpal].X_WOpenXr.linear().col(2);
  const OpenXrJoints fitted = to_openxr(hand, from_openxr(hand, joints));
  EXPECT_GT(fitted[metacarpal].X_WOpenXr.linear().col(2).dot(bone), std::cos(0.1));
}

TEST(OpenXr, AllocatesNothing) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "allocations are not counted";
  const HandModel hand = make_hand();
  HandPose pose;
  const std::int64_t before = test_support::allocations_of_this_thread();
  pose.values[value_named("index_pip")] = 2.0;
  hand.chain.clamp(pose.values);
  pose = from_openxr(hand, to_openxr(hand, pose));
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
  EXPECT_GT(pose.values[value_named("index_pip")], 1.5);
}

std::array<double, kAdroitJoints> adroit(const std::vector<std::pair<std::string, double>>& named) {
  std::array<double, kAdroitJoints> joints{};
  for (const auto& [name, angle] : named) {
    const auto* at = std::ranges::find(kAdroitJointNames, name);
    joints.at(static_cast<std::size_t>(at - kAdroitJointNames.begin())) = angle;
  }
  return joints;
}

TEST(Adroit, TakesOverTheAnglesOfWristAndFingers) {
  const HandModel hand = make_hand();
  const HandPose pose = from_adroit(hand,
                                    adroit({{"WRJ1", 0.1},
                                            {"WRJ0", -0.2},
                                            {"FFJ3", 0.15},
                                            {"FFJ2", 0.4},
                                            {"FFJ1", 0.5},
                                            {"FFJ0", 0.6},
                                            {"MFJ3", 0.05},
                                            {"MFJ2", 0.7},
                                            {"RFJ3", -0.1},
                                            {"RFJ1", 0.8},
                                            {"LFJ3", -0.25},
                                            {"LFJ0", 0.9},
                                            {"THJ1", -0.3},
                                            {"THJ0", -0.4}}),
                                    Isometry3d::Identity());
  const auto value = [&](const std::string& name) { return pose.values[value_named(name)]; };
  EXPECT_EQ(value("wrist_abduction"), 0.1);
  EXPECT_EQ(value("wrist_flexion"), -0.2);
  EXPECT_EQ(value("index_mcp"), 0.4);
  EXPECT_EQ(value("index_pip"), 0.5);
  EXPECT_EQ(value("index_dip"), 0.6);
  EXPECT_EQ(value("middle_mcp"), 0.7);
  EXPECT_EQ(value("ring_pip"), 0.8);
  EXPECT_EQ(value("little_dip"), 0.9);
  EXPECT_NEAR(value("middle_index_abduction"), 0.1, 1e-15);
  EXPECT_NEAR(value("ring_middle_abduction"), 0.15, 1e-15);
  EXPECT_NEAR(value("little_ring_abduction"), 0.15, 1e-15);
  EXPECT_EQ(value("thumb_mcp"), 0.3) << "negative in flexion there, positive here";
  EXPECT_EQ(value("thumb_ip"), 0.4);
}

// z to the fingers, x to the thumb's side, y out of the back there; x, y and z here.
TEST(Adroit, TurnsTheAxesOfTheWrist) {
  const HandPose pose = from_adroit(make_hand(), {}, test_support::at(1.0, 2.0, 3.0));
  EXPECT_TRUE(pose.X_WR.translation().isApprox(Vector3d(1.0, 2.0, 3.0), 0.0));
  EXPECT_TRUE(pose.X_WR.linear().col(0).isApprox(Vector3d::UnitZ(), 0.0));
  EXPECT_TRUE(pose.X_WR.linear().col(1).isApprox(Vector3d::UnitX(), 0.0));
  EXPECT_TRUE(pose.X_WR.linear().col(2).isApprox(Vector3d::UnitY(), 0.0));
}

/// The direction of the thumb's metacarpal in our hand.
Vector3d thumb_of(const HandModel& hand, const HandPose& pose) {
  std::vector<Isometry3d> X_WL(kHandLinks);
  hand.chain.poses(Isometry3d::Identity(), pose.values, X_WL);
  return X_WL[4].linear().col(0);
}

TEST(Adroit, PointsTheThumbAsTheRecordedOneDoes) {
  const HandModel hand = make_hand();
  const auto thumb = [&](double THJ4, double THJ3) {
    return thumb_of(hand, from_adroit(hand, adroit({{"THJ4", THJ4}, {"THJ3", THJ3}}), Isometry3d::Identity()));
  };
  EXPECT_TRUE(thumb(0.0, 0.0).isApprox(Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0.0), 1e-6)) << "beside the palm";
  const Vector3d before = thumb(0.0, 1.2);
  EXPECT_LT(before.z(), -0.8) << "before the palm";
  EXPECT_LT(thumb(0.8, 1.2).y(), before.y() - 0.1) << "and across it";
}

TEST(Adroit, ArchesThePalmAsFarAsTheRecordedHandAtMost) {
  const HandPose pose = from_adroit(make_hand(), adroit({{"LFJ4", 0.698}}), Isometry3d::Identity());
  EXPECT_GT(pose.values[value_named("palm_arch")], 0.4);
  EXPECT_LT(pose.values[value_named("palm_arch")], 30.0 * pi / 180.0);
}

TEST(Adroit, RefusesALeftHand) {
  test_support::expect_bad_input([] { from_adroit(make_hand({.side = HandSide::kLeft}), {}, Isometry3d::Identity()); },
                                 {"left"});
}

}  // namespace
}  // namespace glissade::grasping

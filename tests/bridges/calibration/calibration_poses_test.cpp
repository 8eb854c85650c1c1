/// The poses of a calibration are poses that a hand can take, and in which thumb and fingertip touch.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <glissade/bridges/calibration_poses.h>
#include <glissade/grasping/hand_conversions.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::bridges {
namespace {

constexpr std::size_t kTipOfThumb = 5;

TEST(CalibrationPoses, AreWithinTheRangesOfAHand) {
  for (const CalibrationPose& pose : calibration_poses()) {
    for (std::size_t j = 0; j < hands::kJoints; ++j) {
      if (!pose.angles[j]) continue;
      const double degrees = *pose.angles[j] * 180.0 / M_PI;
      EXPECT_GE(degrees, hands::kJointRanges[j].lower_deg - 1e-9) << pose.name << ", " << hands::kJointNames[j];
      EXPECT_LE(degrees, hands::kJointRanges[j].upper_deg + 1e-9) << pose.name << ", " << hands::kJointNames[j];
    }
  }
}

/// The skin of the tips is a sphere round the joint `tip` of OpenXR. Fingertips yield by some millimetres.
TEST(CalibrationPoses, BringTheTipOfTheThumbToTheTipOfEachFinger) {
  const grasping::HandModel hand = grasping::make_hand();
  const std::array<std::pair<const char*, std::size_t>, 4> tips{
      {{"thumb to index", 10}, {"thumb to middle", 15}, {"thumb to ring", 20}, {"thumb to little", 25}}};
  for (const auto& [name, tip] : tips) {
    std::size_t p = 0;
    while (calibration_poses()[p].name != name)
      ++p;
    const grasping::HandPose pose{.values = posture_of(calibration_poses()[p])};
    const grasping::OpenXrJoints joints = grasping::to_openxr(hand, pose);
    const grasping::OpenXrJoint& thumb = joints[kTipOfThumb];
    const grasping::OpenXrJoint& finger = joints[tip];
    const double distance = (thumb.X_WOpenXr.translation() - finger.X_WOpenXr.translation()).norm();
    EXPECT_NEAR(distance, thumb.radius + finger.radius, 0.009) << name;
  }
}

/// Each joint of a finger has two angles far enough apart to tell its gain.
TEST(CalibrationPoses, TellTheGainsOfThumbAndFingers) {
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    const bool is_straight_in_all = hands::kJointNames[j].starts_with("wrist");
    double least = 10.0;
    double most = -10.0;
    for (const CalibrationPose& pose : calibration_poses()) {
      least = std::min(least, pose.angles[j].value_or(least));
      most = std::max(most, pose.angles[j].value_or(most));
    }
    if (!is_straight_in_all) EXPECT_GE(most - least, 15.0 * M_PI / 180.0 - 1e-9) << hands::kJointNames[j];
  }
}

}  // namespace
}  // namespace glissade::bridges

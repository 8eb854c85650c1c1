/// A wearer who is guided through the poses, on a simulated clock.

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/guided_calibration.h>

#include "posing_glove.h"

namespace glissade::bridges {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kPause_s = 3.0;
constexpr double kHold_s = 2.0;

class GuidedCalibrationTest : public testing::Test {
 protected:
  GuidedCalibrationTest() {
    info.side = hands::HandSide::kRight;
    info.descriptor.name = "glove";
  }

  /// The wearer takes each pose a second after it was asked for. `late` seconds are lost before the first one.
  hands::JointValues posture(double seconds) const {
    const double time = seconds - 1.0 - late;
    const auto pose = static_cast<std::size_t>(std::clamp(time / (kPause_s + kHold_s), 0.0, 6.0));
    return posture_of(calibration_poses()[pose]);
  }

  std::optional<GuidedCalibration> calibrate() {
    return guide_calibration(glove, info, options, clock, [this] { return goes_on; },
                             {.say = [this](const std::string& text) { said.push_back(text); },
                              .show = [this](const std::string& text) { shown.push_back(text); }});
  }

  std::string refusal() {
    try {
      calibrate();
    } catch (const CalibrationError& error) {
      return error.what();
    }
    return {};
  }

  double late = 0.0;
  bool goes_on = true;
  realtime::SimulatedClock clock;
  PosingGlove glove{clock, [this](double seconds) { return posture(seconds); }};
  devices::GloveInfo info;
  GuidedCalibrationOptions options{.pause = std::chrono::duration<double>(kPause_s),
                                   .hold = std::chrono::duration<double>(kHold_s)};
  std::vector<std::string> said;
  std::vector<std::string> shown;
};

TEST_F(GuidedCalibrationTest, CalibratesAGloveWithWrongSensors) {
  glove.sensors = WrongSensors::random(7);
  const auto result = calibrate();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->calibration.device, "glove");
  EXPECT_EQ(result->calibration.side, hands::HandSide::kRight);
  devices::GloveState state;
  const hands::JointValues fist = posture_of(calibration_poses()[1]);
  state.joint_angles = glove.sensors.reported(fist);
  result->calibration.apply(state);
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    if (calibration_poses()[1].angles[j])
      EXPECT_NEAR(state.joint_angles[j], fist[j], 0.02) << hands::kJointNames[j] << ": noise of 1 deg, a mean of many";
  }
}

TEST_F(GuidedCalibrationTest, AsksForEachPoseWithACountdown) {
  ASSERT_TRUE(calibrate());
  ASSERT_EQ(said.size(), kCalibrationPoses);
  EXPECT_THAT(said.front(), HasSubstr("pose 1 of 7, flat: Lay the hand flat"));
  EXPECT_THAT(said.back(), HasSubstr("pose 7 of 7, spread"));
  EXPECT_THAT(shown, Contains("take the pose: 3"));
  EXPECT_THAT(shown, Contains("take the pose: 1"));
  EXPECT_THAT(shown, Contains("hold still"));
}

TEST_F(GuidedCalibrationTest, AsksAgainWhenTheHandMoves) {
  late = kPause_s + 0.5 * kHold_s - 1.0;  // the wearer changes each pose in the middle of a hold
  options.tries = 2;
  EXPECT_THAT(refusal(), HasSubstr("the pose 'fist' failed 2 times: the hand was not still"));
  EXPECT_THAT(said, Contains(HasSubstr("once more")));
}

TEST_F(GuidedCalibrationTest, RefusesAGloveThatAServerCommands) {
  glove.obeys_another = true;
  EXPECT_THAT(refusal(), HasSubstr("end the server first"));
}

TEST_F(GuidedCalibrationTest, RefusesAGloveThatIsCalibrated) {
  info.is_calibrated = true;
  EXPECT_THAT(refusal(), HasSubstr("without --calibration"));
  EXPECT_TRUE(said.empty());
}

TEST_F(GuidedCalibrationTest, EndsWhenTheWearerEndsIt) {
  goes_on = false;
  EXPECT_FALSE(calibrate());
}

TEST_F(GuidedCalibrationTest, FindsWhereATrackerIsWorn) {
  const Eigen::Isometry3d X_TH =
      Eigen::Translation3d(-0.06, 0.01, -0.03) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.0, 0.6, 0.8));
  options.X_WH_flat = Eigen::Translation3d(0.3, -0.1, 0.02) * Eigen::Quaterniond::Identity();
  glove.X_WT = *options.X_WH_flat * X_TH.inverse();
  const auto result = calibrate();
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->calibration.X_TH.isApprox(X_TH, 1e-9));
}

TEST(HeldPose, NeedsStates) {
  const std::vector<devices::GloveState> states(5);
  EXPECT_THROW(held_pose(states, {}), CalibrationError);
}

TEST(HeldPose, DoesNotMindATrackerThatJumpsOnce) {
  std::vector<devices::GloveState> states(30);
  for (devices::GloveState& state : states)
    state.X_WH.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix();
  states[4].X_WH.translation().x() = 5.0;
  states[5].X_WH.linear().setIdentity();
  const Eigen::Isometry3d X_WT = held_pose(states, {}).X_WT;
  EXPECT_TRUE(X_WT.isApprox(states[0].X_WH, 1e-12));
}

}  // namespace
}  // namespace glissade::bridges

/// The fit of sensors, and the data that it refuses.

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/calibration_fit.h>

#include "calibration/line_fit.h"
#include "posing_glove.h"

namespace glissade::bridges {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t kFittedMcp = 4;
constexpr std::size_t kFittedPip = 5;
constexpr std::size_t kMissingJoint = 10;
constexpr std::size_t kFirstStraight = 20;
constexpr std::size_t kFlat = 0;
constexpr std::size_t kFist = 1;
constexpr std::size_t kThumbToIndex = 2;
constexpr std::size_t kSpread = 6;

using Poses = std::array<HeldPose, kCalibrationPoses>;

/// What sensors report of a wearer who shows the poses exactly.
Poses exact_poses(const WrongSensors& sensors) {
  Poses poses;
  for (std::size_t p = 0; p < kCalibrationPoses; ++p) {
    poses[p].angles = sensors.reported(posture_of(calibration_poses()[p]));
    for (std::size_t j = 0; j < poses[p].angles.size(); ++j) {
      poses[p].least[j] = poses[p].angles[j] - 0.01;
      poses[p].most[j] = poses[p].angles[j] + 0.01;
    }
  }
  return poses;
}

std::string refused_fit(const Poses& poses, const std::vector<std::string>& without = {}) {
  try {
    fit_joints(poses, without);
  } catch (const CalibrationError& error) {
    return error.what();
  }
  return {};
}

TEST(CalibrationFit, FindsGainAndOffsetOfEverySensor) {
  const WrongSensors sensors = WrongSensors::random(3);
  const JointFits fits = fit_joints(exact_poses(sensors), {});
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    SCOPED_TRACE(hands::kJointNames[j]);
    ASSERT_TRUE(fits.joints[j]);
    const bool has_one_angle = j >= kFirstStraight;  // the wrist is straight in all poses
    const double gain = has_one_angle ? 1.0 : sensors.joints[j].gain;
    EXPECT_NEAR(fits.joints[j]->gain, gain, 1e-5);
    EXPECT_NEAR(fits.joints[j]->angle(sensors.joints[j].reported(0.0)), 0.0, 1e-5);
    EXPECT_NEAR(fits.joints[j]->residual, 0.0, 1e-5);
  }
  EXPECT_TRUE(fits.remarks.empty());
}

TEST(CalibrationFit, KeepsTheRangeOfThePosesForTheWatchOverDrift) {
  const JointFits fits = fit_joints(exact_poses({}), {});
  EXPECT_NEAR(fits.joints[kFittedPip]->reported_least, 0.0, 1e-5);
  EXPECT_NEAR(fits.joints[kFittedPip]->reported_most, 100.0 * M_PI / 180.0, 1e-5);
}

TEST(CalibrationFit, ForgetsAPoseThatTheWearerShowsDifferently) {
  Poses poses = exact_poses({});
  poses[kSpread].angles[kFittedMcp] += 0.6;
  const JointFits fits = fit_joints(poses, {});
  EXPECT_NEAR(fits.joints[kFittedMcp]->gain, 1.0, 1e-5);
  EXPECT_NEAR(fits.joints[kFittedMcp]->offset, 0.0, 1e-5);
  EXPECT_GT(fits.joints[kFittedMcp]->residual, 0.05) << "it says that the poses differ";
  EXPECT_THAT(fits.remarks, ElementsAre(AllOf(HasSubstr("'spread'"), HasSubstr("index_mcp is 34 deg"))));
}

TEST(CalibrationFit, LeavesSensorsThatDoNotExist) {
  Poses poses = exact_poses({});
  for (HeldPose& pose : poses)
    pose.angles[kMissingJoint] = pose.least[kMissingJoint] = pose.most[kMissingJoint] = 0.0;
  EXPECT_FALSE(fit_joints(poses, {}).joints[kMissingJoint]);
}

TEST(CalibrationFit, RefusesASensorThatHardlyMoves) {
  Poses poses = exact_poses({});
  for (HeldPose& pose : poses)
    pose.angles[kFittedPip] *= 0.1;
  EXPECT_THAT(refused_fit(poses), HasSubstr("index_pip turned by only 10 deg"));
  EXPECT_EQ(refused_fit(poses, {"index_pip"}), "");
}

TEST(CalibrationFit, RefusesASensorThatIsTurnedRound) {
  Poses poses = exact_poses({});
  for (HeldPose& pose : poses)
    pose.angles[kFittedPip] *= -1.0;
  EXPECT_THAT(refused_fit(poses), HasSubstr("index_pip do not follow the poses"));
}

TEST(CalibrationFit, RefusesAFistThatIsNone) {
  Poses poses = exact_poses({});
  poses[kFist] = poses[kFlat];
  EXPECT_THAT(refused_fit(poses), HasSubstr("index_mcp"));
  EXPECT_THAT(refused_fit(poses), HasSubstr("little_dip")) << "each joint with bad data";
}

TEST(CalibrationFit, RefusesAHandThatDoesNotMove) {
  Poses poses;
  EXPECT_THAT(refused_fit(poses), HasSubstr("no joint has moved"));
}

/// 200 wearers, each of whom shows each pose with an error of 3 degrees, and one pose quite differently. The error at
/// an angle of 1 rad, with sensors whose errors are up to 60 degrees.
TEST(CalibrationFit, MakesNoisySensorsGood) {
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(0.0, 3.0 * M_PI / 180.0);
  double worst = 0.0;
  double sum = 0.0;
  int count = 0;
  for (unsigned wearer = 0; wearer < 200; ++wearer) {
    const WrongSensors sensors = WrongSensors::random(wearer);
    Poses poses = exact_poses(sensors);
    for (HeldPose& pose : poses) {
      for (const std::size_t j : {kFittedMcp, kFittedPip})
        pose.angles[j] += noise(generator) / sensors.joints[j].gain;
    }
    poses[kThumbToIndex].angles[kFittedMcp] += 0.4 / sensors.joints[kFittedMcp].gain;
    const JointFits fits = fit_joints(poses, {});
    for (const std::size_t j : {kFittedMcp, kFittedPip}) {
      const double error = std::abs(fits.joints[j]->angle(sensors.joints[j].reported(1.0)) - 1.0) * 180.0 / M_PI;
      worst = std::max(worst, error);
      sum += error;
      ++count;
    }
  }
  RecordProperty("mean_deg", std::to_string(sum / count));
  RecordProperty("worst_deg", std::to_string(worst));
  EXPECT_LT(sum / count, 3.0) << "no worse than one pose";
  EXPECT_LT(worst, 12.0);
}

TEST(LineFit, PassesThroughMostPointsWhateverOneOfThemIs) {
  const std::vector<LinePoint> points{{0.0, 0.1}, {1.0, 1.1}, {2.0, 2.1}, {3.0, -7.0}};
  const auto line = robust_line(points, 0.2, 5.0);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope, 1.0, 1e-12);
  EXPECT_NEAR(line->offset, 0.1, 1e-12);
}

TEST(LineFit, NeedsTwoPoints) {
  EXPECT_FALSE(robust_line({{1.0, 1.0}}, 0.2, 5.0));
  EXPECT_FALSE(robust_line({{1.0, 1.0}, {1.0, 2.0}}, 0.2, 5.0)) << "vertical";
}

}  // namespace
}  // namespace glissade::bridges

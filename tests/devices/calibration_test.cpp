/// Calibrations: their files, and what they make of states, limits and descriptors.

#include <cmath>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/calibration.h>

namespace glissade::devices {
namespace {

using testing::HasSubstr;

constexpr std::size_t kCalibrated = 4;
constexpr std::size_t kUncalibrated = 5;

/// Of a sensor that shows 80 degrees as 0.9, and its zero as 0.1.
Calibration calibration_of_index() {
  Calibration calibration{.user = "anna", .device = "glove", .side = hands::HandSide::kRight};
  calibration.joints[kCalibrated] =
      JointCalibration{.gain = 1.75, .offset = -0.175, .reported_least = 0.1, .reported_most = 0.9, .residual = 0.02};
  calibration.X_TH = Eigen::Translation3d(-0.05, 0.0, -0.03) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY());
  return calibration;
}

/// The message of the error, or nothing.
std::string refusal_of(const std::string& text) {
  try {
    parse_calibration(text, "anna.yaml");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

const std::string kHead = "user: anna\ndevice: glove\nside: right\n";

TEST(Calibration, OfAFileReadsBackAsTheSame) {
  const Calibration calibration = calibration_of_index();
  const Calibration read = parse_calibration(text_of(calibration), "copy");
  EXPECT_EQ(read.user, calibration.user);
  EXPECT_EQ(read.device, calibration.device);
  EXPECT_EQ(read.side, calibration.side);
  EXPECT_EQ(read.joints, calibration.joints);
  EXPECT_TRUE(read.X_TH.isApprox(calibration.X_TH, 1e-14));
}

TEST(Calibration, MayHaveATrackerAlone) {
  const Calibration read = parse_calibration(kHead + "tracker: {position_m: [0.01, 0, -0.02]}\n", "by_hand");
  EXPECT_EQ(read.X_TH.translation(), Eigen::Vector3d(0.01, 0.0, -0.02));
  EXPECT_TRUE(read.X_TH.linear().isIdentity(0.0));
  EXPECT_FALSE(read.joints[kCalibrated]);
}

TEST(Calibration, SaysInWhichLineAFileIsWrong) {
  const std::string numbers = "offset_rad: 0, reported_least_rad: 0, reported_most_rad: 1, residual_rad: 0";
  const auto joint = [&](const std::string& contents) { return kHead + "joints:\n  index_mcp: {" + contents + "}\n"; };
  EXPECT_EQ(refusal_of(joint("gain: 1, " + numbers)), "");
  EXPECT_THAT(refusal_of(joint("gain: -1, " + numbers)), HasSubstr("anna.yaml:5: gain: must be from 0.2 to 5"));
  EXPECT_THAT(refusal_of(joint("gain: .nan, " + numbers)), HasSubstr("anna.yaml:5: gain"));
  EXPECT_THAT(refusal_of(joint(numbers)), HasSubstr("gain"));
  EXPECT_THAT(refusal_of(joint("gain: 1, bias: 0, " + numbers)), HasSubstr("bias"));
  EXPECT_THAT(refusal_of(joint("gain: 1, offset_rad: 0, reported_least_rad: 1, reported_most_rad: 0, residual_rad: 0")),
              HasSubstr("reported_most_rad"));
  EXPECT_THAT(refusal_of(kHead + "joints: {index_knuckle: {}}\n"), HasSubstr("anna.yaml:4"));
  EXPECT_THAT(refusal_of("user: anna\ndevice: glove\nside: both\n"), HasSubstr("anna.yaml:3: side"));
  EXPECT_THAT(refusal_of("device: glove\nside: right\n"), HasSubstr("user"));
  EXPECT_THAT(refusal_of(kHead + "tracker: {position_m: [0, 0, 2]}\n"), HasSubstr("anna.yaml:4: position_m"));
  EXPECT_THAT(refusal_of(kHead + "tracker: {position_m: [0, 0, 0], orientation_wxyz: [1, 1, 0, 0]}\n"),
              HasSubstr("orientation_wxyz"));
}

TEST(Calibration, TurnsReportedAnglesIntoThoseOfTheHand) {
  GloveState state;
  state.joint_angles[kCalibrated] = 0.9;
  state.joint_angles[kUncalibrated] = 0.5;
  calibration_of_index().apply(state);
  EXPECT_NEAR(state.joint_angles[kCalibrated], 1.4, 1e-12);
  EXPECT_EQ(state.joint_angles[kUncalibrated], 0.5) << "not calibrated";
}

/// A tracker beside the wrist moves otherwise than the wrist when the hand turns.
TEST(Calibration, PutsTheHandWhereTheTrackerIsWorn) {
  const Calibration calibration = calibration_of_index();
  const auto tracker_at = [](double t) {
    GloveState state;
    state.X_WH = Eigen::Translation3d(0.2 * t, 0.1, 0.3) * Eigen::AngleAxisd(1.5 * t, Eigen::Vector3d(0.0, 0.6, 0.8));
    state.v_WH = {0.2, 0.0, 0.0};
    state.w_WH = 1.5 * Eigen::Vector3d(0.0, 0.6, 0.8);
    return state;
  };
  GloveState before = tracker_at(0.5 - 1e-6);
  GloveState now = tracker_at(0.5);
  GloveState after = tracker_at(0.5 + 1e-6);
  const Eigen::Isometry3d X_WT = now.X_WH;
  for (GloveState* const state : {&before, &now, &after})
    calibration.apply(*state);
  EXPECT_TRUE(now.X_WH.isApprox(X_WT * calibration.X_TH));
  const Eigen::Vector3d velocity = (after.X_WH.translation() - before.X_WH.translation()) / 2e-6;
  EXPECT_TRUE(now.v_WH.isApprox(velocity, 1e-6)) << now.v_WH.transpose() << " instead of " << velocity.transpose();
  EXPECT_GT((now.v_WH - Eigen::Vector3d(0.2, 0.0, 0.0)).norm(), 0.01) << "the lever of this test does nothing";
}

/// The device evaluates the limit with the angles that it reports. The finger must feel the limit of the hand.
TEST(Calibration, LetsTheDeviceHoldLimitsOfTheHand) {
  const Calibration calibration = calibration_of_index();
  JointLimits wanted;
  wanted.joints[kCalibrated] = {.lower = -0.2, .upper = 0.7, .stiffness = 3.0, .damping = 0.05, .max_torque = 0.4};
  wanted.joints[kUncalibrated] = wanted.joints[kCalibrated];
  const JointLimits held = calibration.to_device(wanted);
  const JointCalibration& joint = *calibration.joints[kCalibrated];
  for (const double angle : {-0.5, -0.21, 0.0, 0.69, 0.75, 2.0}) {
    for (const double rate : {-3.0, 0.0, 2.0}) {
      const double torque = limit_torque(held.joints[kCalibrated], joint.reported(angle), rate / joint.gain);
      EXPECT_NEAR(torque, limit_torque(wanted.joints[kCalibrated], angle, rate), 1e-12) << angle << " rad, " << rate;
    }
  }
  EXPECT_EQ(held.joints[kUncalibrated], wanted.joints[kUncalibrated]) << "not calibrated";
}

TEST(Calibration, LeavesAFreeJointFree) {
  const JointLimits free = calibration_of_index().to_device({});
  EXPECT_EQ(free.joints[kCalibrated].upper, kNoLimit_rad);
  EXPECT_EQ(free.joints[kCalibrated].lower, -kNoLimit_rad);
  EXPECT_FALSE(free.any());
}

TEST(Calibration, ChangesTheDescriptorAsTheAngles) {
  DeviceDescriptor device;
  device.joint_lower[kCalibrated] = 0.1;
  device.joint_upper[kCalibrated] = 0.9;
  device.joint_resolution = 0.01;
  device.max_limit_stiffness = 3.5;
  const DeviceDescriptor calibrated = calibration_of_index().calibrated(device);
  EXPECT_NEAR(calibrated.joint_lower[kCalibrated], 0.0, 1e-12);
  EXPECT_NEAR(calibrated.joint_upper[kCalibrated], 1.4, 1e-12);
  EXPECT_NEAR(calibrated.joint_resolution, 0.0175, 1e-12);
  EXPECT_NEAR(calibrated.max_limit_stiffness, 2.0, 1e-12) << "of the device's loop: 3.5 per reported rad";
}

TEST(Calibration, KeepsAbsentJointsAbsent) {
  const DeviceDescriptor calibrated = calibration_of_index().calibrated({});
  EXPECT_EQ(calibrated.joint_lower[kCalibrated], 0.0);
  EXPECT_EQ(calibrated.joint_upper[kCalibrated], 0.0);
}

TEST(Calibration, IsForOneDeviceAndOneSide) {
  const Calibration calibration = calibration_of_index();
  DeviceDescriptor device;
  device.name = "glove";
  EXPECT_NO_THROW(check_calibration(calibration, device, hands::HandSide::kRight));
  EXPECT_THROW(check_calibration(calibration, device, hands::HandSide::kLeft), std::invalid_argument);
  device.max_force = 1.0;
  EXPECT_THROW(check_calibration(calibration, device, hands::HandSide::kRight), std::invalid_argument)
      << "the force would act at another place than the one that it is meant for";
  device = {};
  device.name = "other glove";
  EXPECT_THROW(check_calibration(calibration, device, hands::HandSide::kRight), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::devices

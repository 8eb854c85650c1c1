/// Curls of fingers, angles of joints, and limits of both.

#include "opengloves/curl_limits.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/bridges/opengloves.h>

#include "hand/finger_curls.h"

namespace glissade::bridges {
namespace {

constexpr double kTorque = 0.5;  // Nm, that of the device
constexpr std::size_t kThumbIp = 2;
constexpr std::size_t kThumbAbduction = 3;
constexpr std::size_t kIndexInnerJoint = 4;
constexpr std::size_t kIndexMiddleJoint = 5;
constexpr std::size_t kPalmArch = 19;
constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

devices::JointLimits limit_at(std::size_t joint, double upper, double max_torque = kTorque) {
  devices::JointLimits limits;
  limits.joints[joint] = {.upper = upper, .stiffness = 1.0, .max_torque = max_torque};
  return limits;
}

TEST(Curl, IsTheShareOfTheSensorsRange) {
  EXPECT_EQ(curl_of(0, {0, 4095}), 0.0);
  EXPECT_EQ(curl_of(4095, {0, 4095}), 1.0);
  EXPECT_NEAR(curl_of(300, {200, 600}), 0.25, 1e-12);
  EXPECT_NEAR(curl_of(300, {600, 200}), 0.75, 1e-12) << "a sensor that counts down";
  EXPECT_EQ(curl_of(65535, {0, 4095}), 1.0);
}

TEST(Angles, GoFromTheOpenHandToTheFist) {
  const hands::JointValues open = angles_of({0, 0, 0, 0, 0});
  const hands::JointValues half = angles_of({0, 0.5, 0, 0, 0});
  const hands::JointValues fist = angles_of({1, 1, 1, 1, 1});
  EXPECT_EQ(open[kIndexInnerJoint], 0.0);
  EXPECT_NEAR(half[kIndexInnerJoint], 40 * kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(half[kIndexMiddleJoint], 50 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(half[kThumbIp], open[kThumbIp]) << "fingers are independent";
  for (std::size_t j = 0; j < hands::kJoints; ++j) {
    for (const double angle : {open[j], fist[j]}) {
      EXPECT_GE(angle, hands::kJointRanges[j].lower_deg * kRadiansPerDegree) << hands::kJointNames[j];
      EXPECT_LE(angle, hands::kJointRanges[j].upper_deg * kRadiansPerDegree) << hands::kJointNames[j];
    }
  }
}

TEST(Angles, AreThoseOfTheDescriptor) {
  const devices::DeviceDescriptor glove = opengloves_descriptor();
  EXPECT_NO_THROW(devices::validate(glove));
  EXPECT_EQ(glove.finger_command, devices::FingerCommand::kCurlLimit);
  EXPECT_EQ(glove.max_force, 0.0);
  EXPECT_GT(devices::passive_limit_stiffness(glove), 0.0);
  EXPECT_EQ(glove.max_joint_torque, opengloves_model().string.torque) << "the numbers of the preset";
  EXPECT_EQ(glove.joint_upper[kIndexMiddleJoint], angles_of({1, 1, 1, 1, 1})[kIndexMiddleJoint]);
  EXPECT_EQ(glove.joint_upper[kPalmArch], 0.0) << "a joint that the glove lacks";
}

TEST(CurlLimit, IsFreeWithoutLimits) {
  EXPECT_EQ(curl_limits({}, FingerValues{}, kTorque), (FingerValues{1, 1, 1, 1, 1}));
  EXPECT_EQ(limit_numbers({1, 1, 1, 1, 1}, {}), (FingerNumbers{0, 0, 0, 0, 0}));
}

TEST(CurlLimit, IsWhereAJointThatIsAloneLimitedIsAtItsLimit) {
  const devices::JointLimits limits = limit_at(kIndexInnerJoint, 40 * kRadiansPerDegree);
  EXPECT_NEAR(curl_limits(limits, FingerValues{}, kTorque)[1], 0.5, 1e-12);
  EXPECT_NEAR(curl_limits(limits, {0.3, 0.3, 0.3, 0.3, 0.3}, kTorque)[1], 0.5, 1e-12) << "wherever the finger is";
  EXPECT_NEAR(curl_limits(limits, {0.6, 0.6, 0.6, 0.6, 0.6}, kTorque)[1], 0.5, 1e-12) << "also beyond it";
  EXPECT_EQ(curl_limits(limits, FingerValues{}, kTorque)[2], 1.0) << "of this finger only";
}

// A contact at the fingertip closes when the inner joint alone turns by 40°, or the middle one alone by 30°. At a curl
// of c they turn by 80° c and 100° c together.
TEST(CurlLimit, IsWhereAContactOfAllJointsCloses) {
  devices::JointLimits limits = limit_at(kIndexInnerJoint, 40 * kRadiansPerDegree);
  limits.joints[kIndexMiddleJoint] = {.upper = 30 * kRadiansPerDegree, .stiffness = 1.0, .max_torque = kTorque};
  EXPECT_NEAR(curl_limits(limits, FingerValues{}, kTorque)[1], 1.0 / (80.0 / 40.0 + 100.0 / 30.0), 1e-12);
}

TEST(CurlLimit, CountsAJointWhoseAngleFallsAsTheFingerCloses) {
  devices::JointLimits limits;
  const double half = angles_of({0.5, 0, 0, 0, 0})[kThumbAbduction];
  limits.joints[kThumbAbduction] = {.lower = half, .stiffness = 1.0, .max_torque = kTorque};
  EXPECT_NEAR(curl_limits(limits, FingerValues{}, kTorque)[0], 0.5, 1e-12);
  EXPECT_EQ(curl_limits(limit_at(kThumbAbduction, half), FingerValues{}, kTorque)[0], 1.0) << "against opening";
}

TEST(CurlLimit, OpensAsItsTorqueFades) {
  const double upper = 40 * kRadiansPerDegree;
  EXPECT_NEAR(curl_limits(limit_at(kIndexInnerJoint, upper, 0.5 * kTorque), FingerValues{}, kTorque)[1], 0.75, 1e-12);
  EXPECT_EQ(curl_limits(limit_at(kIndexInnerJoint, upper, 0.0), FingerValues{}, kTorque)[1], 1.0);
}

TEST(CurlLimit, IgnoresWhatTheGloveCannotHold) {
  devices::JointLimits lower;
  lower.joints[kIndexInnerJoint] = {.lower = 1.0, .stiffness = 1.0, .max_torque = kTorque};
  EXPECT_EQ(curl_limits(lower, FingerValues{}, kTorque)[1], 1.0) << "it does not pull fingers closed";
  EXPECT_EQ(curl_limits(limit_at(kPalmArch, 0.1), FingerValues{}, kTorque), (FingerValues{1, 1, 1, 1, 1}));
  EXPECT_EQ(
      curl_limits(limit_at(kIndexInnerJoint, std::numeric_limits<double>::quiet_NaN()), FingerValues{}, kTorque)[1],
      1.0);
}

TEST(LimitNumbers, RoundToTheFreerSide) {
  EXPECT_EQ(limit_numbers({0.5, 0.4996, 0.0, 0.9999, 1.0}, {}), (FingerNumbers{500, 500, 1000, 0, 0}));
}

TEST(LimitNumbers, NeverPullAFingerOpen) {
  const FingerNumbers numbers = limit_numbers({0.5, 0.5, 0.5, 0.5, 0.5}, {0.2, 0.5, 0.7, 1.0, 0.0});
  EXPECT_EQ(numbers, (FingerNumbers{500, 500, 300, 0, 500}));
}

}  // namespace
}  // namespace glissade::bridges

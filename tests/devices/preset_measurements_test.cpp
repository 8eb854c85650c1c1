/// The presets as an experimenter would measure them, beside what is published about the devices and about hands.

#include <chrono>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove.h>

#include "glove_model/finger_dynamics.h"

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kIndexBase = 4;  // index_mcp

hands::JointValues everywhere(double angle) {
  hands::JointValues angles{};
  angles.fill(angle);
  return angles;
}

JointLimits closed_from(double upper) {
  JointLimits limits{.expiry = std::chrono::hours(1)};
  for (JointLimit& joint : limits.joints)
    joint = {.upper = upper, .stiffness = 20.0, .max_torque = 10.0};
  return limits;
}

/// A calm wearer, who grips so hard.
GloveModel calm(const char* preset, double grip_Nm) {
  GloveModel model = read_glove_model(preset);
  model.wearer.tremor = 0.0;
  model.wearer.grip = grip_Nm;
  return model;
}

/// The torque with which the device stops a finger of a wearer who is stronger.
double holding_torque(const char* preset) {
  FingerDynamics fingers(calm(preset, 5.0), {});
  const JointLimits limits = closed_from(0.3);
  for (int ms = 0; ms < 3000; ++ms)
    fingers.advance(milliseconds(1), everywhere(1.2), true, {.limits = &limits});
  return -fingers.loads()[kIndexBase];
}

// The dry friction adds to the torque of motor and brake, as in a real gear.
TEST(PresetMeasurements, DevicesStopFingersWithTheirPublishedForces) {
  EXPECT_NEAR(holding_torque("dynamixel"), 0.52, 0.02) << "stall torque of the XL330-M288, data sheet";
  EXPECT_NEAR(holding_torque("sense_glove_r1"), 20.0 * 0.030, 0.025) << "20 N on 30 mm";
  EXPECT_NEAR(holding_torque("brake"), 20.0 * 0.020, 0.011) << "20 N on 20 mm, SenseGlove Nova";
  EXPECT_NEAR(holding_torque("opengloves"), 0.18, 0.001) << "stall torque of the MG90S, 1.8 kg cm";
}

TEST(PresetMeasurements, FreeFingerOfTheSenseGloveR1FeelsItsFloor) {
  FingerDynamics fingers(calm("sense_glove_r1", 0.2), {});
  double sum = 0.0;
  for (int ms = 0; ms < 1000; ++ms) {
    fingers.advance(milliseconds(1), everywhere(0.5e-3 * ms), true, {});
    if (ms >= 500) sum -= fingers.loads()[kIndexBase] / 500.0;
  }
  EXPECT_NEAR(sum / 0.030, 0.8, 0.1) << "N, on 30 mm";
}

// A wearer who moves the finger to and fro with less than the friction of the gear.
TEST(PresetMeasurements, ServoGloveHasTheBacklashOfItsGear) {
  const GloveModel model = calm("dynamixel", 0.2);
  FingerDynamics fingers(model, everywhere(0.3));
  const auto pushed = [&](double aim) {
    for (int ms = 0; ms < 2000; ++ms)
      fingers.advance(milliseconds(1), everywhere(aim), true, {});
    // The linkage gives way as well.
    return fingers.angles()[kIndexBase] + fingers.loads()[kIndexBase] / model.actuator.link_stiffness;
  };
  const double lost = pushed(0.32) - pushed(0.28);
  EXPECT_NEAR(lost * 180.0 / std::numbers::pi, 0.33, 0.01) << "degrees, data sheets of the class";
}

// From the open string to one that is taut 60° earlier: the way and two steps of the servo.
TEST(PresetMeasurements, HobbyServoTurns60DegreesInATenthOfASecond) {
  const GloveModel model = calm("opengloves", 0.2);
  FingerStrings strings(model);
  hands::JointValues angles{};
  for (const std::size_t joint : {4U, 5U, 6U})
    angles[joint] = hands::kJointRanges[joint].upper_deg * std::numbers::pi / 180.0;
  constexpr double kWay = std::numbers::pi / 3.0;
  JointLimits limits{.expiry = std::chrono::hours(1)};
  limits.joints[kIndexBase] = {.upper = angles[kIndexBase] - kWay, .stiffness = 1.0, .max_torque = 1.0};
  const double whole = model.string.stiffness * kWay;
  nanoseconds now{0};
  double torque = 0.0;
  // The torque is capped, so the string is followed by a finger that yields a third of the way.
  angles[kIndexBase] -= kWay - 0.5 * model.string.torque / model.string.stiffness;
  for (; torque < 0.49 * model.string.torque && now < milliseconds(500); now += kFingerStep) {
    strings.advance(now, 125e-6, {.limits = &limits}, angles, {});
    torque = -strings.torque(kIndexBase);
  }
  EXPECT_GT(whole, model.string.torque);
  const double seconds = std::chrono::duration<double>(now).count() - model.servo.delay;
  EXPECT_NEAR(seconds, 0.1, 0.01) << "data sheet of the MG90S at 4.8 V";
}

TEST(PresetMeasurements, CameraErrsAndWaitsAsPublished) {
  SimulatedGlove glove(geometry::PoseTrajectory({geometry::TimedPose{}}), {}, read_glove_model("camera"));
  double squares = 0.0;
  double squares_of_wrist = 0.0;
  int states = 0;
  nanoseconds least = std::chrono::seconds(1);
  std::int64_t last = 0;
  for (int ms = 0; ms < 120'000; ++ms) {
    glove.step(milliseconds(1), {});
    if (glove.state().sequence == last) continue;
    last = glove.state().sequence;
    ++states;
    least = std::min(least, glove.state_age());
    for (std::size_t j = 0; j < hands::kJoints; ++j)
      squares += std::pow(glove.state().joint_angles[j] - glove.true_state().joint_angles[j], 2) / hands::kJoints;
    squares_of_wrist += (glove.state().X_WH.translation() - glove.true_state().X_WH.translation()).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / states) * 180.0 / std::numbers::pi, 9.6, 0.5) << "degrees, PMC10830632";
  EXPECT_NEAR(1e3 * std::sqrt(squares_of_wrist / states), 11.0, 0.5) << "mm, the same";
  EXPECT_GE(least, milliseconds(38));
  EXPECT_LE(least, milliseconds(45)) << "the same";
}

// A torque on the base of a relaxed finger turns it by torque over stiffness.
TEST(PresetMeasurements, RelaxedFingerIsAsStiffAsPublished) {
  GloveModel model;
  model.fingers = FingerKind::kTorque;
  model.actuator.is_driven.fill(true);
  model.actuator.motor_torque = 1.0;
  model.wearer.tremor = model.wearer.open_grip = model.wearer.reflex_gain = 0.0;
  FingerDynamics fingers(model, everywhere(0.3));
  for (int ms = 0; ms < 5000; ++ms)
    fingers.advance(milliseconds(1), everywhere(0.3), false, {.torques = everywhere(0.005)});
  const double stiffness = 0.005 / (fingers.angles()[kIndexBase] - 0.3);
  EXPECT_GE(stiffness, 0.033) << "Nm/rad, PMC7775510";
  EXPECT_LE(stiffness, 0.047) << "the same";
}

}  // namespace
}  // namespace glissade::devices

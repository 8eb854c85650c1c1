/// Fingers of a model that an emulated firmware drives.

#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kRingMcp = 11;

/// Fingers without tremor and reflex, so that they rest.
GloveModel still(const char* preset) {
  GloveModel model = read_glove_model(preset);
  model.wearer.tremor = 0.0;
  model.wearer.reflex_gain = 0.0;
  return model;
}

double stiffness_of(const FingerWearerModel& wearer) {
  return wearer.stiffness + wearer.stiffness_per_grip * wearer.open_grip;
}

TEST(DrivenFingers, MotorTurnsItsJointToTheBalanceWithTheWearer) {
  const GloveModel model = still("dynamixel");
  DrivenFingers fingers(model, {});
  hands::JointValues torques{};
  torques[kRingMcp] = 0.04;  // less than the grip, which would yield
  fingers.set_torques(torques);
  fingers.advance(milliseconds(2000), {}, false);
  // The friction of the motor holds the rest, either way.
  const double k = stiffness_of(model.wearer);
  EXPECT_NEAR(fingers.angles()[kRingMcp], 0.04 / k, model.actuator.coulomb_friction / k);
  const double felt = k * fingers.angles()[kRingMcp];
  const double stretch = felt / model.actuator.link_stiffness + 0.5 * model.actuator.backlash;
  EXPECT_NEAR(fingers.actuator_angles()[kRingMcp] - fingers.angles()[kRingMcp], stretch, 1e-4);
  EXPECT_NEAR(fingers.actuator_rates()[kRingMcp], 0.0, 1e-3);
  EXPECT_EQ(fingers.angles()[kRingMcp + 1], 0.0) << "ring_pip has no motor";
}

TEST(DrivenFingers, StringStopsTheSumOfAFinger) {
  const GloveModel model = still("opengloves");
  DrivenFingers fingers(model, {});
  hands::JointValues fist{};
  fist[kRingMcp] = fist[kRingMcp + 1] = fist[kRingMcp + 2] = 0.5;
  DrivenFingers::PerFinger taut{9, 9, 9, 1.2, 9};
  fingers.set_strings(taut);
  fingers.advance(milliseconds(2000), fist, false);
  // Three springs of the wearer against the string: k (0.5 - q) = s (3 q - 1.2).
  const double k = stiffness_of(model.wearer);
  const double s = model.string.stiffness;
  EXPECT_NEAR(fingers.flexion_sums()[3], 3.0 * (0.5 * k + 1.2 * s) / (k + 3.0 * s), 1e-3);
  taut[3] = 9;
  fingers.set_strings(taut);
  fingers.advance(milliseconds(2000), fist, false);
  EXPECT_NEAR(fingers.flexion_sums()[3], 1.5, 1e-3);
}

TEST(DrivenFingers, AreThoseOfAFirmwareWithMotorsOrStrings) {
  EXPECT_THROW(DrivenFingers(read_glove_model("camera"), {}), std::invalid_argument);
  EXPECT_THROW(DrivenFingers(read_glove_model("omega_3"), {}), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::devices

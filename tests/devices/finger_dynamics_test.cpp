#include "glove_model/finger_dynamics.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kIndex = 4;  // index_mcp

/// Every joint is driven without friction. The wearer does not tremble and has no reflex.
GloveModel quiet_model(FingerKind kind) {
  GloveModel model;
  model.fingers = kind;
  model.wearer.tremor = 0.0;
  model.wearer.reflex_gain = 0.0;
  model.actuator.is_driven.fill(true);
  model.actuator.motor_torque = 0.5;
  return model;
}

/// Closes all joints against upper limits of 0.5 rad.
JointLimits limits_at(double upper) {
  JointLimits limits;
  for (JointLimit& joint : limits.joints)
    joint = {.upper = upper, .stiffness = 2.0, .damping = 0.0, .max_torque = 0.5};
  return limits;
}

hands::JointValues all(double angle) {
  hands::JointValues angles{};
  angles.fill(angle);
  return angles;
}

void run(FingerDynamics& fingers, int ticks, double aim, const FingerOrder& order) {
  for (int i = 0; i < ticks; ++i)
    fingers.advance(milliseconds(1), all(aim), true, order);
}

TEST(FingerDynamics, TakesStepsOfTheSameLengthForAnyDivisionOfTime) {
  const GloveModel model = quiet_model(FingerKind::kTorque);
  FingerDynamics one(model, {});
  FingerDynamics two(model, {});
  one.advance(milliseconds(70), all(0.3), true, {});
  for (int i = 0; i < 700; ++i)
    two.advance(std::chrono::microseconds(100), all(0.3), true, {});
  EXPECT_EQ(one.steps(), 560);
  EXPECT_EQ(two.steps(), 560);
  EXPECT_EQ(one.angles(), two.angles());
}

TEST(FingerDynamics, MotorTurnsTheFingerByTorqueOverStiffness) {
  const GloveModel model = quiet_model(FingerKind::kTorque);
  FingerDynamics fingers(model, all(0.3));
  run(fingers, 3000, 0.3, {.torques = all(0.1)});
  const double stiffness = model.wearer.stiffness + model.wearer.stiffness_per_grip * model.wearer.grip;
  EXPECT_NEAR(fingers.angles()[kIndex], 0.3 + 0.1 / stiffness, 1e-6);
  EXPECT_NEAR(fingers.loads()[kIndex], 0.1, 1e-6);
}

TEST(FingerDynamics, MotorExertsNoMoreThanItsCurrentPermits) {
  GloveModel model = quiet_model(FingerKind::kTorque);
  model.actuator.motor_torque = 0.05;
  FingerDynamics fingers(model, all(0.3));
  run(fingers, 3000, 0.3, {.torques = all(0.1)});
  EXPECT_NEAR(fingers.loads()[kIndex], 0.05, 1e-6);
}

// Against a limit, wearer and limit are two springs: they balance where their torques are equal.
TEST(FingerDynamics, RestsBeyondALimitWhereTheSpringsBalance) {
  const GloveModel model = quiet_model(FingerKind::kJointLimit);
  FingerDynamics fingers(model, {});
  const JointLimits limits = limits_at(0.5);
  run(fingers, 4000, 0.6, {.limits = &limits});
  const double wearer = model.wearer.stiffness + model.wearer.stiffness_per_grip * model.wearer.grip;
  const double link = model.actuator.link_stiffness;
  const double limit = 1.0 / (1.0 / 2.0 + 1.0 / link);  // in series
  EXPECT_NEAR(fingers.angles()[kIndex], (wearer * 0.6 + limit * 0.5) / (wearer + limit), 1e-6);
}

// The teeth lie on, so the finger is where the limit is, and the actuator half of the backlash before it.
TEST(FingerDynamics, BacklashDoesNotMoveALimit) {
  GloveModel model = quiet_model(FingerKind::kJointLimit);
  FingerDynamics without(model, {});
  model.actuator.backlash = 0.02;
  FingerDynamics with(model, {});
  const JointLimits limits = limits_at(0.5);
  run(without, 4000, 0.6, {.limits = &limits});
  run(with, 4000, 0.6, {.limits = &limits});
  EXPECT_NEAR(with.angles()[kIndex], without.angles()[kIndex], 1e-4);
}

TEST(FingerDynamics, LimitsDoNotActBeforeTheyAreReached) {
  FingerDynamics fingers(quiet_model(FingerKind::kJointLimit), {});
  const JointLimits limits = limits_at(0.5);
  run(fingers, 1000, 0.4, {.limits = &limits});
  EXPECT_NEAR(fingers.angles()[kIndex], 0.4, 1e-4);
  EXPECT_NEAR(fingers.loads()[kIndex], 0.0, 1e-6);
}

// The finger presses. After the expiry and one period of the loop, the motor exerts nothing.
TEST(FingerDynamics, OpensItsLimitsWhenTheCommandExpires) {
  GloveModel model = quiet_model(FingerKind::kJointLimit);
  model.servo.rate = 500.0;
  model.actuator.bandwidth = 1e6;
  FingerActuators actuators(model, all(0.6));
  const JointLimits limits = limits_at(0.5);
  const nanoseconds last = limits.expiry + milliseconds(2);
  for (nanoseconds now{0}; now < milliseconds(30); now += kFingerStep) {
    actuators.advance(now, 125e-6, {.limits = &limits, .age = now}, all(0.6));
    if (now <= limits.expiry) EXPECT_NEAR(actuators.motor_torque(kIndex), -0.2, 1e-3) << now.count();
    if (now >= last) EXPECT_NEAR(actuators.motor_torque(kIndex), 0.0, 1e-3) << now.count();
  }
}

TEST(FingerDynamics, TorqueFollowsAFirstOrderLag) {
  GloveModel model = quiet_model(FingerKind::kTorque);
  model.actuator.bandwidth = 10.0;
  FingerActuators actuators(model, {});
  nanoseconds now{0};
  const double time_constant = 1.0 / (2.0 * 3.14159265358979 * 10.0);
  for (; now < nanoseconds(std::llround(1e9 * time_constant)); now += kFingerStep)
    actuators.advance(now, 125e-6, {.torques = all(0.4)}, {});
  EXPECT_NEAR(actuators.motor_torque(kIndex), 0.4 * (1.0 - std::exp(-1.0)), 0.002);
}

TEST(FingerDynamics, TorqueWaitsForTheDelayOfTheLoop) {
  GloveModel model = quiet_model(FingerKind::kTorque);
  model.servo.delay = 0.005;
  model.actuator.bandwidth = 1e6;
  FingerActuators actuators(model, {});
  for (nanoseconds now{0}; now < milliseconds(10); now += kFingerStep) {
    actuators.advance(now, 125e-6, {.torques = all(0.4)}, {});
    EXPECT_NEAR(actuators.motor_torque(kIndex), now < milliseconds(5) ? 0.0 : 0.4, 1e-3) << now.count();
  }
}

// A brake gives back nothing: from the moment when the wearer rests, the finger does not move.
TEST(FingerDynamics, BrakeHoldsTheFingerAndNeverMovesIt) {
  GloveModel model = quiet_model(FingerKind::kBrake);
  model.actuator.motor_torque = 0.0;
  model.actuator.brake_torque = 0.5;
  FingerDynamics fingers(model, all(0.45));
  const JointLimits limits = limits_at(0.5);
  double work = 0.0;  // of the device on the finger, J
  for (int i = 0; i < 3000; ++i) {
    fingers.advance(milliseconds(1), all(i < 1500 ? 0.8 : 0.45), true, {.limits = &limits});
    work += fingers.loads()[kIndex] * fingers.rates()[kIndex] * 1e-3;
    EXPECT_LT(work, 1e-5);
    if (i == 1499) EXPECT_LT(fingers.angles()[kIndex], 0.65) << "against the aim of 0.8 rad";
  }
  EXPECT_NEAR(fingers.angles()[kIndex], 0.45, 0.01) << "it does not hold the finger that opens";
}

TEST(FingerDynamics, StringsStopTheCurlAndNeverPush) {
  GloveModel model = quiet_model(FingerKind::kCurlLimit);
  model.servo.rate = 50.0;
  model.string.damping = 0.0005;
  FingerDynamics fingers(model, all(0.2));
  JointLimits limits;
  limits.joints[kIndex] = {.upper = 0.5, .stiffness = 2.0, .damping = 0.0, .max_torque = 0.3};
  limits.expiry = std::chrono::seconds(1);
  run(fingers, 3000, 0.8, {.limits = &limits});
  EXPECT_LT(fingers.angles()[kIndex], 0.72);
  EXPECT_LT(fingers.loads()[kIndex], -0.02);
  EXPECT_EQ(fingers.loads()[kIndex], fingers.loads()[kIndex + 1]) << "the string pulls on all joints of the finger";
  EXPECT_EQ(fingers.loads()[8], 0.0) << "but not on the next finger";
  run(fingers, 1000, 0.3, {.limits = &limits});
  EXPECT_NEAR(fingers.angles()[kIndex], 0.3, 1e-3);
  EXPECT_EQ(fingers.loads()[kIndex], 0.0);
}

// The reflex stiffens the finger in two halves, after 34.6 and 59.8 ms.
TEST(FingerWearer, StiffensAfterTheLatenciesOfTheReflex) {
  FingerWearerModel model;
  FingerWearer wearer(model, {}, 1, 1e-4);
  const double relaxed = model.stiffness;
  const double half = model.stiffness_per_grip * model.reflex_gain * 0.5 * 0.2;
  for (int i = 0; i < 1000; ++i) {
    wearer.advance({}, all(-0.2));
    EXPECT_NEAR(wearer.stiffness(kIndex, 0.0), relaxed + (i >= 346 ? half : 0.0) + (i >= 598 ? half : 0.0), 1e-12) << i;
  }
}

TEST(FingerWearer, StiffnessGrowsLinearlyWithTheGrip) {
  const FingerWearerModel model;
  const FingerWearer wearer(model, {}, 1, 1e-4);
  EXPECT_DOUBLE_EQ(wearer.stiffness(kIndex, 0.0), model.stiffness);
  EXPECT_DOUBLE_EQ(wearer.stiffness(kIndex, 0.1), model.stiffness + 0.1 * model.stiffness_per_grip);
}

// A hand that intends to be a radian farther than the finger can go presses with its grip, whatever its stiffness.
TEST(FingerWearer, PressesWithTheGrip) {
  for (const double grip : {0.05, 0.2}) {
    GloveModel model = quiet_model(FingerKind::kJointLimit);
    model.wearer.grip = grip;
    model.wearer.reflex_gain = 0.5;
    FingerDynamics fingers(model, all(0.4));
    const JointLimits limits = limits_at(0.5);
    run(fingers, 3000, 1.5, {.limits = &limits});
    EXPECT_NEAR(fingers.loads()[kIndex], -grip, 1e-3);
  }
}

// A finger that nothing stops goes all the way.
TEST(FingerWearer, GoesWhereItIntendsIfItCan) {
  FingerDynamics fingers(quiet_model(FingerKind::kTracked), {});
  run(fingers, 2000, 1.2, {});
  EXPECT_NEAR(fingers.angles()[kIndex], 1.2, 1e-3);
}

// Crossings of zero in ten seconds give the frequency; the mean square gives the amplitude.
TEST(FingerWearer, TremblesWithinItsBand) {
  const FingerWearerModel model;
  FingerWearer wearer(model, {}, 7, 1e-3);
  for (std::size_t joint = 0; joint < hands::kJoints; joint += 7) {
    int crossings = 0;
    double squares = 0.0;
    double last = wearer.aim(joint, 0.0, 0.2);
    for (int i = 0; i < 10000; ++i) {
      wearer.advance({}, {});
      const double now = wearer.aim(joint, 0.0, 0.2);
      crossings += now * last < 0.0 ? 1 : 0;
      squares += now * now;
      last = now;
    }
    EXPECT_GE(crossings, 2 * 60 - 1);
    EXPECT_LE(crossings, 2 * 120 + 1);
    EXPECT_NEAR(std::sqrt(squares / 10000), model.tremor, 0.02 * model.tremor);
  }
}

}  // namespace
}  // namespace glissade::devices

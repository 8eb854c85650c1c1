#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove.h>

#include "allocation_counter.h"
#include "expect_bad_input.h"
#include "glove_model/delay_line.h"
#include "glove_model/finger_dynamics.h"
#include "glove_model/random_numbers.h"
#include "safe_command.h"

namespace glissade::devices {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

const std::string kArm =
    "name: arm\n"
    "summary: An arm\n"
    "update_rate_Hz: 1000\n"
    "wrist:\n"
    "  kind: grounded\n"
    "  max_force_N: 12\n"
    "  max_torque_Nm: 0\n"
    "  max_stiffness_N_per_m: 5000\n"
    "  max_rotational_stiffness_Nm_per_rad: 0\n"
    "  max_damping_N_s_per_m: 30\n"
    "  damping_N_s_per_m: 2.5\n"
    "  rotational_damping_Nm_s_per_rad: 0\n"
    "fingers:\n"
    "  kind: absent\n";

std::string with(std::string text, const std::string& old_part, const std::string& new_part) {
  const std::size_t at = text.find(old_part);
  return text.replace(at, old_part.size(), new_part);
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
  test_support::expect_bad_input([&] { parse_glove_model(text, "arm.yaml"); }, parts);
}

geometry::PoseTrajectory at_rest() {
  return geometry::PoseTrajectory({{std::chrono::seconds(0), Isometry3d::Identity()}});
}

/// Joints close from 0 to 0.8 rad within half a second.
SimulatedGloveParameters closing_hand() {
  SimulatedGloveParameters parameters;
  hands::JointValues closed{};
  closed.fill(0.8);
  parameters.fingers = {{milliseconds(0), {}}, {milliseconds(500), closed}};
  return parameters;
}

class Preset : public testing::TestWithParam<std::string_view> {
 protected:
  GloveModel model = read_glove_model(std::string(GetParam()));
};

TEST_P(Preset, LoadsAndIsDescribedInASentence) {
  EXPECT_FALSE(model.name.empty());
  EXPECT_GT(model.summary.size(), 20U);
  EXPECT_NO_THROW(validate(model));
}

TEST_P(Preset, AnnouncesAValidDescriptorWithItsOwnNumbers) {
  const DeviceDescriptor descriptor = descriptor_of(model);
  EXPECT_NO_THROW(validate(descriptor));
  EXPECT_EQ(descriptor.name, model.name);
  EXPECT_EQ(descriptor.max_force, model.wrist.max_force);
  if (model.wrist.max_force > 0.0) EXPECT_EQ(descriptor.max_stiffness, model.wrist.max_stiffness);
  EXPECT_GT(descriptor.max_stiffness, 0.0) << "no server takes a device without";
  EXPECT_GT(descriptor.max_rotational_stiffness, 0.0);
  EXPECT_EQ(descriptor.update_rate, model.update_rate);
  for (std::size_t j = 0; j < hands::kJoints && model.fingers == FingerKind::kJointLimit; ++j)
    EXPECT_EQ(descriptor.drives(j), model.actuator.is_driven[j]) << j;
  if (descriptor.finger_command == FingerCommand::kTorque) return;
  EXPECT_EQ(descriptor.limit_rate, model.servo.rate);
  EXPECT_EQ(descriptor.max_limit_stiffness, model.servo.max_stiffness);
  EXPECT_GT(passive_limit_stiffness(descriptor), 0.0);
}

// The wearer, who does not tremble, presses against a limit. After four seconds, a stable loop is at rest.
TEST_P(Preset, HoldsLimitsOfItsLargestStiffnessWithoutShaking) {
  if (descriptor_of(model).finger_command == FingerCommand::kTorque) return;
  model.wearer.tremor = 0.0;
  hands::JointValues aims{};
  aims.fill(0.7);
  FingerDynamics fingers(model, {});
  JointLimits limits;
  for (JointLimit& limit : limits.joints)
    limit = {.upper = 0.4, .stiffness = model.servo.max_stiffness, .damping = 0.0, .max_torque = 0.5};
  limits.expiry = std::chrono::seconds(1);
  const auto run = [&](int ticks) {
    double fastest = 0.0;
    for (int i = 0; i < ticks; ++i) {
      fingers.advance(milliseconds(1), aims, true, {.limits = &limits});
      for (const double rate : fingers.rates())
        fastest = std::max(fastest, std::abs(rate));
    }
    return fastest;
  };
  run(4000);
  EXPECT_LT(run(500), 0.005) << "rad/s";
  EXPECT_LT(fingers.angles()[4], 0.65) << "the limit holds the finger back from its aim of 0.7 rad";
}

TEST_P(Preset, AllocatesNothingInItsSteps) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "a sanitizer allocates";
  SimulatedGlove glove(at_rest(), closing_hand(), model);
  const SafeCommand command;
  const std::int64_t before = test_support::allocations_of_this_thread();
  for (int i = 0; i < 300; ++i)
    glove.step(milliseconds(1), command);
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
}

TEST_P(Preset, RepeatsTheSameBitsAndSurvivesACopy) {
  SimulatedGlove one(at_rest(), closing_hand(), model);
  SimulatedGlove two = one;
  GloveCommand command;
  for (JointLimit& limit : command.joint_limits.joints)
    limit = {.upper = 0.4, .stiffness = 1.0, .damping = 0.001, .max_torque = 0.1};
  const SafeCommand safe = test_support::safe_command(command, one.descriptor());
  for (int i = 0; i < 700; ++i) {
    one.step(milliseconds(1), safe);
    two.step(milliseconds(1), safe);
    ASSERT_EQ(one.state().joint_angles, two.state().joint_angles) << i;
    ASSERT_EQ(one.state().X_WH.matrix(), two.state().X_WH.matrix()) << i;
    ASSERT_EQ(one.true_state().joint_angles, two.true_state().joint_angles) << i;
    for (const double angle : one.true_state().joint_angles)
      ASSERT_TRUE(std::isfinite(angle)) << i;
  }
  EXPECT_GT(one.state().sequence, 15) << "at 60 Hz and more";
}

INSTANTIATE_TEST_SUITE_P(All, Preset, testing::ValuesIn(glove_presets()),
                         [](const auto& preset) { return std::string(preset.param); });

TEST(GloveModelFile, GivesAnArmWithoutFingers) {
  const GloveModel model = parse_glove_model(kArm, "arm.yaml");
  EXPECT_EQ(model.fingers, FingerKind::kAbsent);
  const DeviceDescriptor descriptor = descriptor_of(model);
  EXPECT_EQ(descriptor.max_force, 12.0);
  EXPECT_EQ(descriptor.joint_upper, hands::JointValues{});
}

TEST(GloveModelFile, ErrorsNameFileLineAndKey) {
  expect_refused(with(kArm, "max_force_N", "max_force"), {"arm.yaml:6", "max_force", "did you mean 'max_force_N'"});
  expect_refused(with(kArm, "5000", "stiff"), {"arm.yaml:8", "max_stiffness_N_per_m", "finite number"});
  expect_refused(with(kArm, "12", "-12"), {"arm.yaml:6", "max_force_N", "between 0 and"});
  expect_refused(with(kArm, "update_rate_Hz: 1000\n", ""), {"update_rate_Hz", "missing"});
  expect_refused(with(kArm, "absent", "wooden"), {"arm.yaml:14", "kind", "joint-limit", "wooden"});
  expect_refused(with(kArm, "grounded", "tracker"), {"arm.yaml:6", "max_force_N", "unknown key"});
  expect_refused(with(kArm, "grounded", "half-spaces"), {"arm.yaml:5", "loop_rate_Hz", "missing"});
  expect_refused(kArm + "  servo: {}\n", {"arm.yaml:15", "servo", "unknown key"});
  expect_refused(kArm + "link: {loss: 2}\n", {"arm.yaml:15", "loss", "between 0 and 1"});
  expect_refused(kArm + "seed: 0.5\n", {"arm.yaml:15", "seed", "whole number"});
  expect_refused("name: [", {"arm.yaml", "not valid YAML"});
  test_support::expect_bad_input([] { read_glove_model("no_such_glove"); }, {"no_such_glove", "camera"});
  test_support::expect_bad_input([] { read_glove_model("omega_4"); }, {"did you mean 'omega_"});
}

TEST(GloveModelFile, ErrorsNameTheJoint) {
  const std::string fingers =
      "fingers:\n"
      "  kind: joint-limit\n"
      "  actuator: {motor_torque_Nm: 0.5, brake_torque_Nm: 0, gear_ratio: 1, rotor_inertia_kg_m2: 1e-5,\n"
      "    coulomb_friction_Nm: 0, viscous_friction_Nm_s_per_rad: 0, backlash_rad: 0,\n"
      "    link_stiffness_Nm_per_rad: 10, link_damping_Nm_s_per_rad: 0, bandwidth_Hz: 100, joints: JOINTS}\n"
      "  servo: {rate_Hz: 1000, delay_s: 0, resolution_rad: 0, max_stiffness_Nm_per_rad: 2}\n";
  const std::string text = with(kArm, "fingers:\n  kind: absent\n", fingers);
  EXPECT_TRUE(parse_glove_model(with(text, "JOINTS", "[index_mcp]"), "arm.yaml").actuator.is_driven[4]);
  expect_refused(with(text, "JOINTS", "[index_mpc]"), {"arm.yaml:17", "index_mpc", "index_mcp"});
  expect_refused(with(text, "JOINTS", "[]"), {"drive no joint"});
}

TEST(GloveModel, ComplaintsNameTheNumber) {
  GloveModel model = read_glove_model("dynamixel");
  model.servo.rate = std::numeric_limits<double>::quiet_NaN();
  test_support::expect_bad_input([&] { validate(model); }, {"fingers.servo.rate_Hz", model.name});
  test_support::expect_bad_input([&] { SimulatedGlove(at_rest(), {}, model); }, {"fingers.servo.rate_Hz"});
  model = read_glove_model("opengloves");
  model.string.stiffness = 1e5;
  test_support::expect_bad_input([&] { validate(model); }, {"too stiff"});
}

// A tracker feels no force: the same command moves the hand of an arm only.
TEST(GloveModel, OnlyAGroundedArmPushesTheHand) {
  GloveCommand command;
  command.f_H_W = Vector3d(3, 0, 0);
  GloveModel model = parse_glove_model(kArm, "arm.yaml");
  const SafeCommand safe = test_support::safe_command(command, descriptor_of(model));
  SimulatedGlove grounded(at_rest(), {}, model);
  model.wrist.is_grounded = false;
  SimulatedGlove free(at_rest(), {}, model);
  for (int i = 0; i < 3000; ++i) {
    grounded.step(milliseconds(1), safe);
    free.step(milliseconds(1), safe);
  }
  EXPECT_NEAR(grounded.state().X_WH.translation().x(), 3.0 / SimulatedGloveParameters().wearer_stiffness, 1e-9);
  EXPECT_EQ(free.state().X_WH.translation().x(), 0.0);
  EXPECT_EQ(free.descriptor().max_force, 0.0);
}

// The wearer's spring of 400 N/m against the one of the device: the hand stops halfway.
TEST(GloveModel, ArmHoldsHalfSpacesInItsOwnLoop) {
  const std::string text = with(kArm, "grounded\n", "half-spaces\n  loop_rate_Hz: 2000\n  loop_delay_s: 0.001\n");
  const GloveModel model = parse_glove_model(text, "arm.yaml");
  const DeviceDescriptor descriptor = descriptor_of(model);
  EXPECT_EQ(descriptor.tool_command, ToolCommand::kHalfSpaces);
  EXPECT_EQ(descriptor.tool_rate, 2000.0);
  EXPECT_EQ(descriptor.tool_delay, milliseconds(1));
  GloveCommand command;
  command.half_spaces.count = 1;
  command.half_spaces.rows[0] = {Vector3d::UnitZ(), Vector3d::Zero(), 10e-3};
  command.half_spaces.stiffness = SimulatedGloveParameters().wearer_stiffness;
  command.half_spaces.rotational_stiffness = 1.0;
  command.half_spaces.max_force = 12.0;
  const SafeCommand safe = test_support::safe_command(command, descriptor);
  SimulatedGlove glove(at_rest(), {}, model);
  for (int i = 0; i < 3000; ++i)
    glove.step(milliseconds(1), safe);
  EXPECT_NEAR(glove.state().X_WH.translation().z(), 5e-3, 1e-6);
}

TEST(GloveModel, MeasuresAtItsRateAndDelaysTheStates) {
  GloveModel model = parse_glove_model(kArm, "arm.yaml");
  model.update_rate = 100.0;
  model.measurement_delay = 0.025;
  SimulatedGlove glove(at_rest(), {}, model);
  for (int ms = 1; ms <= 500; ++ms) {
    const GloveState state = glove.step(milliseconds(1), {});
    const int sequence = std::max(0, (ms - 25) / 10);
    ASSERT_EQ(state.sequence, sequence) << ms;
    ASSERT_EQ(state.time, milliseconds(10 * sequence)) << ms;
    ASSERT_EQ(glove.state_age(), milliseconds(ms - 10 * sequence)) << ms;
  }
}

// A command of 8 N acts after 20 ms on the way.
TEST(GloveModel, LinkDelaysTheCommands) {
  GloveModel model = parse_glove_model(kArm, "arm.yaml");
  model.link.delay = 0.02;
  GloveCommand command;
  command.f_H_W = Vector3d(8, 0, 0);
  const SafeCommand safe = test_support::safe_command(command, descriptor_of(model));
  SimulatedGlove glove(at_rest(), {}, model);
  for (int ms = 1; ms <= 22; ++ms) {
    glove.step(milliseconds(1), safe);
    EXPECT_EQ(glove.true_state().v_WH.x() > 0.0, ms > 20) << ms;
  }
}

TEST(GloveModel, DelayOfTheDescriptorHasBothWaysOfTheLink) {
  GloveModel model = read_glove_model("omega_3");
  model.measurement_delay = 0.002;
  model.link = {.delay = 0.01, .jitter = 0.005};
  EXPECT_EQ(descriptor_of(model).delay, std::chrono::milliseconds(32));
  model.measurement_delay = model.link.delay = model.link.jitter = 0.4;
  EXPECT_EQ(descriptor_of(model).delay, std::chrono::seconds(1)) << "the longest that a descriptor permits";
}

TEST(GloveModel, LinkLosesItsShareOfTheStates) {
  GloveModel model = parse_glove_model(kArm, "arm.yaml");
  model.link.loss = 0.25;
  model.link.jitter = 0.004;
  SimulatedGlove glove(at_rest(), {}, model);
  int arrived = 0;
  std::int64_t last = 0;
  nanoseconds oldest{0};
  for (int i = 0; i < 20000; ++i) {
    const std::int64_t sequence = glove.step(milliseconds(1), {}).sequence;
    ASSERT_GE(sequence, last) << "an older state never replaces a newer one";
    arrived += sequence > last ? 1 : 0;
    last = sequence;
    oldest = std::max(oldest, glove.state_age());
  }
  EXPECT_LT(arrived, 15000) << "a quarter is lost, and some are overtaken";
  EXPECT_GT(arrived, 5000);
  EXPECT_LT(oldest, milliseconds(30));
}

// Mean, deviation and steps of the measured angles of a hand at rest.
TEST(GloveModel, SensorsHaveTheirNoiseAndTheirSteps) {
  GloveModel model = read_glove_model("camera");
  model.measurement_delay = 0.0;
  model.update_rate = 1000.0;
  model.wearer.tremor = 0.0;
  model.sensor = {.resolution = 0.001, .noise = 0.05};
  SimulatedGloveParameters parameters;
  parameters.grasp_posture.fill(0.5);
  SimulatedGlove glove(at_rest(), parameters, model);
  double sum = 0.0;
  double squares = 0.0;
  double positions = 0.0;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const GloveState state = glove.step(milliseconds(1), {});
    const double error = state.joint_angles[7] - 0.5;
    sum += error;
    squares += error * error;
    positions += state.X_WH.translation().squaredNorm();
    const double steps = state.joint_angles[7] / 0.001;
    ASSERT_NEAR(steps, std::round(steps), 1e-9);
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 4 * 0.05 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.05, 0.002);
  EXPECT_NEAR(std::sqrt(positions / kSamples), std::sqrt(3.0) * model.wrist.position_noise, 2e-4);
}

TEST(GloveModel, AnotherSeedGivesOtherNoise) {
  GloveModel model = read_glove_model("camera");
  SimulatedGlove one(at_rest(), {}, model);
  model.seed = 2;
  SimulatedGlove two(at_rest(), {}, model);
  one.step(milliseconds(100), {});
  two.step(milliseconds(100), {});
  one.step(milliseconds(100), {});
  two.step(milliseconds(100), {});
  EXPECT_NE(one.state().joint_angles, two.state().joint_angles);
}

TEST(RandomNumbers, HaveMeanZeroAndDeviationOne) {
  RandomNumbers random(5, 0);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kSamples = 100000;
  for (int i = 0; i < kSamples; ++i) {
    const double number = random.normal();
    sum += number;
    squares += number * number;
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 0.02);
  EXPECT_NEAR(squares / kSamples, 1.0, 0.02);
}

TEST(DelayLine, GivesTheNewestThatHasArrivedAndForgetsOlderOnes) {
  DelayLine<int> line(3);
  int value = 0;
  EXPECT_FALSE(line.take(milliseconds(9), value));
  line.push(1, milliseconds(5));
  line.push(2, milliseconds(2));
  line.push(3, milliseconds(7));
  EXPECT_FALSE(line.take(milliseconds(1), value));
  EXPECT_TRUE(line.take(milliseconds(2), value));
  EXPECT_EQ(value, 2);
  EXPECT_FALSE(line.take(milliseconds(6), value)) << "1 was overtaken";
  EXPECT_TRUE(line.take(milliseconds(7), value));
  EXPECT_EQ(value, 3);
}

}  // namespace
}  // namespace glissade::devices

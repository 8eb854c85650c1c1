/// Checks of a hand's configuration, and what the hand announces.

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <glissade/bridges/dynamixel_hand.h>

namespace glissade::bridges {
namespace {

constexpr int kIndexDip = 6;

DynamixelHand one_finger() {
  DynamixelHand hand;
  hand.servos = {{.id = 1, .joint = kIndexDip}};
  return hand;
}

std::string refusal_of(const DynamixelHand& hand) {
  try {
    validate(hand);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(DynamixelHand, DogloveIsValid) {
  const devices::DeviceDescriptor device = descriptor_of(read_dynamixel_hand("doglove"));
  devices::validate(device);
  EXPECT_EQ(device.finger_command, devices::FingerCommand::kJointLimit);
  EXPECT_EQ(device.update_rate, 200.0);
  EXPECT_EQ(device.max_force, 0.0);
  EXPECT_GT(device.max_stiffness, 0.0) << "else a server refuses the glove";
  int joints = 0;
  for (std::size_t i = 0; i < device.joint_upper.size(); ++i)
    joints += device.joint_upper[i] > device.joint_lower[i] ? 1 : 0;
  EXPECT_EQ(joints, 14) << "the flexion joints";
  const DynamixelHand hand = read_dynamixel_hand("doglove");
  for (std::size_t i = 0; i < device.joint_upper.size(); ++i) {
    const bool has_servo = std::any_of(hand.servos.begin(), hand.servos.end(), [i](const DynamixelServo& servo) {
      return static_cast<std::size_t>(servo.joint) == i;
    });
    EXPECT_EQ(device.drives(i), has_servo) << i;
  }
}

TEST(DynamixelHand, LimitsFollowFromTheDataSheet) {
  DynamixelHand hand = one_finger();
  hand.servos[0].max_current = 1.47;
  EXPECT_NEAR(descriptor_of(hand).max_joint_torque, 0.52, 1e-9) << "the stall torque of an XL330-M288";
  EXPECT_NEAR(descriptor_of(hand).joint_resolution, 2.0 * std::numbers::pi / 4096.0, 1e-12);
  hand.servos[0].ratio = -0.5;
  EXPECT_NEAR(descriptor_of(hand).max_joint_torque, 1.04, 1e-9) << "at a joint that turns half as fast";
  hand.servos[0].torque_per_current = 0.2;
  EXPECT_NEAR(descriptor_of(hand).max_joint_torque, 0.588, 1e-9);
}

TEST(DynamixelHand, MistakesAreNamed) {
  EXPECT_EQ(refusal_of(one_finger()), "");
  DynamixelHand hand = one_finger();
  hand.model = "XM430";
  EXPECT_EQ(refusal_of(hand),
            "Hand 'Dynamixel hand': there is no model XM430; the models are XL330-M288, XL330-M077, XC330-M288, "
            "XC330-M181.");
  hand = one_finger();
  hand.servos[0].id = 253;
  EXPECT_EQ(refusal_of(hand), "Hand 'Dynamixel hand': servo 253: the id must be from 0 to 252.");
  hand = one_finger();
  hand.servos[0].ratio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of(hand), "Hand 'Dynamixel hand': servo 1: ratio must be from 0.01 to 100, or negative.");
  hand = one_finger();
  hand.servos.push_back({.id = 1, .joint = 2});
  EXPECT_EQ(refusal_of(hand), "Hand 'Dynamixel hand': two servos have the id 1.");
  hand = one_finger();
  hand.measured = {{.channel = 0, .joint = kIndexDip}};
  EXPECT_EQ(refusal_of(hand), "Hand 'Dynamixel hand': index_dip is measured by two servos or channels.");
  hand = one_finger();
  hand.watchdog = std::chrono::seconds(3);
  EXPECT_EQ(refusal_of(hand), "Hand 'Dynamixel hand': watchdog must be from 20 ms to 2.54 s.");
}

TEST(DynamixelHand, WireNeedsItsLines) {
  EXPECT_THROW(make_dynamixel_wire(one_finger(), nullptr), std::invalid_argument);
  EXPECT_THROW(make_dynamixel_wire(read_dynamixel_hand("doglove"), nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::bridges

/// The wire to a hand of servos: what the wearer feels.

#include <algorithm>
#include <cmath>

#include "dynamixel/emulated_board.h"
#include "dynamixel/emulated_glove.h"
#include "hand/finger_curls.h"
#include "hand_fixture.h"

namespace glissade::bridges::dynamixel {
namespace {

using std::chrono::milliseconds;

constexpr double kBacklash_rad = 0.33 * std::numbers::pi / 180.0;

class HandWire : public HandOfServos {
 protected:
  HandWire() { wire_->open(); }
};

TEST_F(HandWire, MeasuresTheJointAngles) {
  index_->aim = kZero_rad + 0.4;
  middle_->aim = kZero_rad - 0.1;
  EXPECT_NEAR(run_for(milliseconds(500)), 250, 1) << "one measurement in each period of 2 ms";
  EXPECT_NEAR(state_.joint_angles[kIndexPip], 0.4, kPositionUnit_rad);
  EXPECT_NEAR(state_.joint_angles[kMiddlePip], -0.1, kPositionUnit_rad);
  EXPECT_LE(clock_->now() - state_.time, milliseconds(2));
}

TEST_F(HandWire, LimitHoldsAPressingFinger) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.7;
  run_for(milliseconds(1000));
  // Wearer and servo are two springs: 0.5 (0.7 - q) = 5 (q - 0.5).
  EXPECT_NEAR(index_angle(), 2.85 / 5.5, kBacklash_rad);
  EXPECT_EQ(servo(2).get(kTorqueEnable), 0) << "the other finger is free";
}

TEST_F(HandWire, LowerLimitHoldsAnOpeningFinger) {
  limit_of_index() = {.lower = 0.2, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad;
  run_for(milliseconds(1000));
  EXPECT_NEAR(index_angle(), 1.0 / 5.5, kBacklash_rad);
}

TEST_F(HandWire, TorqueIsAtMostThatOfTheLimit) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.1};
  run_for(milliseconds(500));
  index_->aim = kZero_rad + 1.2;
  run_for(milliseconds(1000));
  EXPECT_NEAR(servo(1).torque(), -0.1, 1e-3);
  EXPECT_LE(-servo(1).torque(), 0.1 + 1e-9);
}

TEST_F(HandWire, TorqueIsOffInsideTheRange) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.2;
  run_for(milliseconds(500));
  EXPECT_EQ(servo(1).get(kTorqueEnable), 0);
  EXPECT_NEAR(index_angle(), 0.2, 1e-3);
}

TEST_F(HandWire, FingerThatLeavesIsNotPulledBack) {
  constexpr double kStiffness = 5.0;
  constexpr double kPeriod_s = 0.002;
  limit_of_index() = {.upper = 0.5, .stiffness = kStiffness, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.5;
  run_for(milliseconds(500));
  double strongest_pull = 0.0;
  double fastest = 0.0;
  for (int i = 0; i < 1500; ++i) {
    index_->aim = kZero_rad + 0.5 + 0.3 * std::sin(0.01 * i);
    period();
    strongest_pull = std::max(strongest_pull, servo(1).torque());
    fastest = std::max(fastest, std::abs(index_->rate()));
  }
  EXPECT_GT(fastest, 0.5);
  EXPECT_LT(fastest, 3.0);
  EXPECT_LE(strongest_pull, kStiffness * (kBacklash_rad + 2.0 * fastest * kPeriod_s));
}

TEST_F(HandWire, LimitThatIsTakenAwayLetsGo) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.7;
  run_for(milliseconds(500));
  EXPECT_EQ(servo(1).get(kTorqueEnable), 1);
  limit_of_index() = {};
  run_for(milliseconds(500));
  EXPECT_EQ(servo(1).get(kTorqueEnable), 0);
  EXPECT_NEAR(index_angle(), 0.7, 1e-3);
}

TEST_F(HandWire, ReleaseTurnsTheTorqueOff) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.7;
  run_for(milliseconds(500));
  EXPECT_FALSE(wire_->traffic().is_free);
  EXPECT_TRUE(wire_->traffic().holds[0]);
  wire_->release();
  EXPECT_EQ(servo(1).get(kTorqueEnable), 0);
  EXPECT_TRUE(wire_->traffic().is_free);
}

TEST_F(HandWire, WatchdogStopsAServoThatHearsNothing) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.7;
  run_for(milliseconds(500));
  const std::int64_t held = servo(1).get(kPresentPosition);
  clock_->advance(milliseconds(100));  // the watchdog runs for 60 ms
  bus_->send_until(clock_->now());
  EXPECT_EQ(servo(1).get(kBusWatchdog), kWatchdogExpired);
  EXPECT_EQ(servo(1).write(kGoalPosition.address, encode_register(kGoalPosition, 0)), StatusError::kDataRange);
  EXPECT_NEAR(static_cast<double>(servo(1).get(kGoalPosition)), static_cast<double>(held), 1.0) << "it holds its place";
}

TEST_F(HandWire, HandThatComesBackAfterTheWatchdogIsHeldAgain) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.7;
  run_for(milliseconds(500));
  clock_->advance(milliseconds(100));
  run_for(milliseconds(1000));
  EXPECT_EQ(wire_->traffic().restarted_watchdogs, 1U);
  EXPECT_EQ(servo(1).get(kBusWatchdog), 3);
  EXPECT_NEAR(index_angle(), 2.85 / 5.5, kBacklash_rad);
}

TEST_F(HandWire, WatchdogSleepsWhileTheTorqueIsOff) {
  run_for(milliseconds(100));
  clock_->advance(milliseconds(500));
  run_for(milliseconds(100));
  EXPECT_EQ(wire_->traffic().restarted_watchdogs, 0U);
}

TEST_F(HandWire, LostTorqueIsSwitchedOnAgain) {
  limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad + 0.7;
  run_for(milliseconds(500));
  servo(1).write(kTorqueEnable.address, encode_register(kTorqueEnable, 0));
  run_for(milliseconds(500));
  EXPECT_EQ(servo(1).get(kTorqueEnable), 1);
  EXPECT_NEAR(index_angle(), 2.85 / 5.5, kBacklash_rad);
}

TEST_F(HandOfServos, WholeTurnsOfTheHornDoNotMatter) {
  index_->aim = kZero_rad + 0.3 + 4.0 * std::numbers::pi;
  clock_->advance(milliseconds(1000));
  wire_->open();
  run_for(milliseconds(100));
  EXPECT_NEAR(state_.joint_angles[kIndexPip], 0.3, kPositionUnit_rad);
}

TEST_F(HandOfServos, RatioAndDirectionOfALinkage) {
  DynamixelHand hand = two_fingers();
  hand.servos[0].ratio = -0.5;
  make_wire(hand);
  wire_->open();
  // The joint closes by 0.3 rad while the horn turns back by 0.6 rad. The finger's spring, which is at the horn, is
  // four times as stiff at the joint.
  limit_of_index() = {.upper = 0.3, .stiffness = 5.0, .max_torque = 0.17};
  index_->aim = kZero_rad - 0.7;
  run_for(milliseconds(1000));
  const double joint = -0.5 * index_angle();
  EXPECT_NEAR(joint, (2.0 * 0.35 + 5.0 * 0.3) / (2.0 + 5.0), kBacklash_rad);
  EXPECT_NEAR(state_.joint_angles[kIndexPip], joint, kPositionUnit_rad);
}

TEST_F(HandOfServos, FastReadingMeasuresTheSame) {
  DynamixelHand hand = two_fingers();
  hand.has_fast_read = true;
  make_wire(hand);
  wire_->open();
  index_->aim = kZero_rad + 0.4;
  EXPECT_NEAR(run_for(milliseconds(500)), 250, 1);
  EXPECT_NEAR(state_.joint_angles[kIndexPip], 0.4, kPositionUnit_rad);
}

TEST_F(HandOfServos, BoardMeasuresMoreJoints) {
  EmulatedBoard::Angles angles{};
  angles[6] = 2.0;
  const auto board =
      std::make_shared<EmulatedBoard>([angles](std::chrono::nanoseconds) { return angles; }, milliseconds(4));
  DynamixelHand hand = two_fingers();
  constexpr int kIndexMcp = 4;
  hand.measured = {{.channel = 6, .joint = kIndexMcp, .ratio = -1.0, .zero = 2.5}};
  make_wire(hand, std::make_shared<EmulatedLine>(board, clock_));
  wire_->open();
  run_for(milliseconds(50));
  EXPECT_NEAR(state_.joint_angles[kIndexMcp], 0.5, 1e-5);
  EXPECT_NEAR(state_.joint_angles[kIndexPip], 0.0, kPositionUnit_rad);
}

TEST_F(HandOfServos, DogloveIsMeasuredByServosAndBoard) {
  const DynamixelHand doglove = read_dynamixel_hand("doglove");
  const FingerValues curls{0.2, 0.4, 0.5, 0.6, 0.8};
  const ServoGlove glove =
      emulate(doglove, model_of(doglove), [&](std::chrono::nanoseconds) { return angles_of(curls); });
  const auto wire = make_dynamixel_wire(doglove, std::make_shared<EmulatedLine>(glove.bus, clock_),
                                        std::make_shared<EmulatedLine>(glove.board, clock_), clock_);
  wire->open();
  for (int i = 0; i < 500; ++i)
    wire->read(state_);
  const hands::JointValues wanted = angles_of(curls);
  constexpr double kTremor_rad = 0.01;
  EXPECT_NEAR(state_.joint_angles[4], wanted[4], kTremor_rad) << "index_mcp, measured by the board";
  EXPECT_NEAR(state_.joint_angles[17], wanted[17], kTremor_rad) << "little_dip, measured by a servo";
  EXPECT_EQ(state_.joint_angles[0], wanted[0]) << "thumb_roll, which nothing measures: opposite to the palm";
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

/// The emulated servo keeps the rules of the data sheet.

#include "dynamixel/emulated_servo.h"

#include <memory>

#include <gtest/gtest.h>

#include "elastic_finger.h"

namespace glissade::bridges::dynamixel {
namespace {

using std::chrono::milliseconds;

class OneEmulatedServo : public testing::Test {
 protected:
  StatusError write(const Register& to, std::int64_t value) {
    return servo_.write(to.address, encode_register(to, value));
  }
  void turn_on() {
    write(kOperatingMode, kCurrentBasedPosition);
    write(kTorqueEnable, 1);
  }

  std::shared_ptr<ElasticFinger> finger_ = std::make_shared<ElasticFinger>(1.0, 0.5, 0.025);
  EmulatedServo servo_{1, *find_model("XL330-M288"), finger_};
};

TEST_F(OneEmulatedServo, HoldsAGoalWithACapOfCurrent) {
  turn_on();
  write(kGoalCurrent, 200);
  write(kGoalPosition, 4000);
  servo_.advance(milliseconds(500));
  EXPECT_EQ(servo_.get(kPresentCurrent), 200);
  EXPECT_NEAR(servo_.torque(), 0.2 * 0.52 / 1.47, 1e-9);
  EXPECT_NEAR(finger_->angle(), 1.0 + servo_.torque() / 0.5, 1e-3) << "the wearer holds against it";
}

TEST_F(OneEmulatedServo, TorqueThatTurnsOnStartsAtThePresentPosition) {
  write(kGoalPosition, 4000);
  turn_on();
  servo_.advance(milliseconds(100));
  EXPECT_NEAR(servo_.torque(), 0.0, 1e-3);
}

TEST_F(OneEmulatedServo, TorqueLocksTheEeprom) {
  turn_on();
  EXPECT_EQ(write(kOperatingMode, 3), StatusError::kAccess);
  EXPECT_EQ(write(kPositionPGain, 100), StatusError::kNone);
}

TEST_F(OneEmulatedServo, WatchdogCountsOnlyWithTorque) {
  write(kBusWatchdog, 2);
  servo_.advance(milliseconds(200));
  EXPECT_EQ(servo_.get(kBusWatchdog), 2);
  turn_on();
  servo_.advance(milliseconds(239));
  EXPECT_EQ(servo_.get(kBusWatchdog), 2);
  servo_.advance(milliseconds(243));
  EXPECT_EQ(servo_.get(kBusWatchdog), kWatchdogExpired);
  EXPECT_EQ(write(kGoalPosition, 0), StatusError::kDataRange);
  EXPECT_EQ(write(kBusWatchdog, 0), StatusError::kNone);
  EXPECT_EQ(write(kGoalPosition, 0), StatusError::kNone);
}

TEST_F(OneEmulatedServo, HardwareErrorNeedsARestart) {
  turn_on();
  servo_.break_down(kOverloadError);
  EXPECT_TRUE(has_alert(servo_.error_byte(StatusError::kNone)));
  write(kTorqueEnable, 1);
  EXPECT_EQ(servo_.get(kTorqueEnable), 0);
  servo_.restart();
  EXPECT_FALSE(has_alert(servo_.error_byte(StatusError::kNone)));
  EXPECT_EQ(servo_.get(kOperatingMode), kCurrentBasedPosition) << "EEPROM stays";
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

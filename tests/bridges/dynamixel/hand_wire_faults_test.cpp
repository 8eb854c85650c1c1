/// The wire to a hand of servos: what goes wrong on the way.

#include <gmock/gmock.h>

#include "dynamixel/emulated_board.h"
#include "hand_fixture.h"

namespace glissade::bridges::dynamixel {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

class HandWithFaults : public HandOfServos {
 protected:
  std::string error_of_opening() {
    return wire_error_of([this] { wire_->open(); });
  }
  std::string error_of_running() {
    return wire_error_of([this] { run_for(milliseconds(500)); });
  }
  void press_on_limit() {
    limit_of_index() = {.upper = 0.5, .stiffness = 5.0, .max_torque = 0.17};
    index_->aim = kZero_rad + 0.7;
  }
};

TEST_F(HandWithFaults, OpeningSetsTheServosUp) {
  EXPECT_EQ(error_of_opening(), "");
  EXPECT_EQ(servo(1).get(kOperatingMode), 5);
  EXPECT_EQ(servo(1).get(kReturnDelayTime), 0);
  EXPECT_EQ(servo(1).get(kCurrentLimit), 500) << "0.5 A";
  EXPECT_EQ(servo(1).get(kBusWatchdog), 3) << "60 ms";
  EXPECT_EQ(servo(1).get(kTorqueEnable), 0);
}

TEST_F(HandWithFaults, MissingServoIsNamed) {
  servo(2).is_connected = false;
  EXPECT_THAT(error_of_opening(), HasSubstr("Servo 2 on an emulated line does not answer"));
}

TEST_F(HandWithFaults, OtherModelIsNamed) {
  servo(1).set(kModelNumber, 1240);
  EXPECT_EQ(error_of_opening(), "Servo 1 on an emulated line is an XC330-M288, but the configuration says XL330-M288.");
  servo(1).set(kModelNumber, 1020);
  EXPECT_THAT(error_of_opening(), HasSubstr("of the unknown model 1020"));
}

TEST_F(HandWithFaults, FastReadingNeedsFirmware) {
  DynamixelHand hand = two_fingers();
  hand.has_fast_read = true;
  make_wire(hand);
  servo(1).set(kFirmwareVersion, 45);
  EXPECT_THAT(error_of_opening(), HasSubstr("has firmware 45, but fast sync read needs 46"));
}

TEST_F(HandWithFaults, HomingOffsetIsRefused) {
  servo(1).set(kHomingOffset, -100);
  EXPECT_THAT(error_of_opening(), HasSubstr("Homing Offset"));
}

TEST_F(HandWithFaults, ExpiredWatchdogIsNoHindrance) {
  servo(1).set(kBusWatchdog, kWatchdogExpired);
  EXPECT_EQ(error_of_opening(), "");
  EXPECT_EQ(servo(1).get(kBusWatchdog), 3);
}

TEST_F(HandWithFaults, OverloadIsReportedAndARestartHelps) {
  wire_->open();
  press_on_limit();
  run_for(milliseconds(200));
  servo(1).break_down(kOverloadError);
  EXPECT_THAT(error_of_running(),
              HasSubstr("Servo 1 on an emulated line has turned its torque off: it was overloaded"));
  wire_->release();
  EXPECT_EQ(error_of_opening(), "");
  run_for(milliseconds(500));
  EXPECT_EQ(servo(1).get(kTorqueEnable), 1);
}

TEST_F(HandWithFaults, HardwareErrorThatStaysIsReported) {
  servo(1).break_down(kInputVoltageError);
  servo(1).survives_restart = true;
  EXPECT_THAT(error_of_opening(), HasSubstr("has a hardware error: the supply voltage is out of range"));
}

TEST_F(HandWithFaults, ServoThatVanishesIsNamed) {
  wire_->open();
  run_for(milliseconds(100));
  servo(2).is_connected = false;
  EXPECT_THAT(error_of_running(), HasSubstr("Servo 2 on an emulated line has not answered for 100 ms"));
}

TEST_F(HandWithFaults, ServoWithoutSupplyForAMomentIsNoticed) {
  wire_->open();
  run_for(milliseconds(100));
  servo(1).restart();
  EXPECT_THAT(error_of_running(), HasSubstr("has lost its settings"));
}

TEST_F(HandWithFaults, UnpluggedAdapterIsAnErrorAndComesBack) {
  wire_->open();
  press_on_limit();
  run_for(milliseconds(200));
  line_->is_plugged = false;
  EXPECT_THAT(error_of_running(), HasSubstr("is not plugged in"));
  wire_->release();
  EXPECT_THAT(error_of_opening(), HasSubstr("is not plugged in"));
  line_->is_plugged = true;
  EXPECT_EQ(error_of_opening(), "");
  run_for(milliseconds(1000));
  EXPECT_NEAR(index_angle(), 2.85 / 5.5, 0.006);
}

TEST_F(HandWithFaults, EchoesAreIgnored) {
  device_->faults.has_echo = true;
  wire_->open();
  press_on_limit();
  EXPECT_NEAR(run_for(milliseconds(1000)), 500, 1);
  EXPECT_NEAR(index_angle(), 2.85 / 5.5, 0.006);
}

TEST_F(HandWithFaults, LimitsHoldOnANoisyLine) {
  wire_->open();
  device_->faults = {.garbage = 0.05, .cut = 0.03, .flipped_bit = 0.03, .has_echo = true};
  press_on_limit();
  const int measured = run_for(milliseconds(3000));
  // 6 of 100 packets are lost, and two packets make a measurement. A lost one takes the patience of 5 ms.
  EXPECT_GT(measured, 700);
  EXPECT_NEAR(index_angle(), 2.85 / 5.5, 0.006);
  EXPECT_GT(wire_->traffic().missing_answers, 10U);
}

TEST_F(HandWithFaults, SlowAnswersAreAwaitedWithinThePatience) {
  device_->faults.slowness = milliseconds(4);
  wire_->open();
  EXPECT_GT(run_for(milliseconds(500)), 80);
}

TEST_F(HandWithFaults, TooSlowAnswersAreMissing) {
  device_->faults.slowness = milliseconds(20);
  EXPECT_THAT(error_of_opening(), HasSubstr("does not answer"));
}

TEST_F(HandWithFaults, SilentBoardIsAnError) {
  class Silent final : public EmulatedDevice {
   public:
    void receive(std::string_view, std::chrono::nanoseconds) override {}
    std::string send_until(std::chrono::nanoseconds) override { return {}; }
    std::optional<std::chrono::nanoseconds> next_time() const override { return {}; }
  };
  DynamixelHand hand = two_fingers();
  hand.measured = {{.channel = 0, .joint = 4}};
  make_wire(hand, std::make_shared<EmulatedLine>(std::make_shared<Silent>(), clock_));
  wire_->open();
  EXPECT_THAT(error_of_running(), HasSubstr("The measuring board on an emulated line has sent nothing for 100 ms"));
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

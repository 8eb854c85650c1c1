/// What the check says about emulated gloves and ports.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/dynamixel_check.h>
#include <glissade/bridges/dynamixel_emulator.h>

namespace glissade::bridges {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kDipOfIndex = 6;
constexpr int kDipOfMiddle = 9;

DynamixelHand two_servos() {
  DynamixelHand hand;
  hand.servos = {{.id = 1, .joint = kDipOfIndex, .zero = 3.0}, {.id = 2, .joint = kDipOfMiddle, .zero = 3.0}};
  hand.patience = std::chrono::milliseconds(20);  // a test may run on a busy machine
  return hand;
}

/// An open hand that trembles only.
DynamixelEmulatorOptions open_hand() {
  return {.wearer = [](std::chrono::nanoseconds) { return angles_of({}); }};
}

std::string findings(const DynamixelHand& hand, const std::string& port, bool expected) {
  std::string text;
  EXPECT_EQ(check_dynamixel(
                hand, port, [] { return true; }, [&](const std::string& line) { text += line + "\n"; }),
            expected)
      << text;
  return text;
}

TEST(DynamixelCheck, ShowsWhatAGloveSays) {
  const DynamixelEmulator glove(two_servos(), open_hand());
  const std::string text = findings(two_servos(), glove.port(), true);
  EXPECT_THAT(text, HasSubstr("the port is open"));
  EXPECT_THAT(text, HasSubstr("servo 1: XL330-M288, firmware 46, 5.0 V"));
  EXPECT_THAT(text, HasSubstr("operating mode 3; the bridge sets 5"));
  EXPECT_THAT(text, HasSubstr("index_dip at "));
  EXPECT_THAT(text, testing::ContainsRegex("the horn at (2.9|3.0)"));
  EXPECT_THAT(text, HasSubstr("a measurement takes"));
}

TEST(DynamixelCheck, ShowsWhatTheBoardMeasures) {
  DynamixelHand hand = two_servos();
  hand.measured = {{.channel = 4, .joint = 4, .zero = 2.25}};
  const DynamixelEmulator glove(hand, open_hand());
  hand.board_port = glove.board_port();
  EXPECT_THAT(findings(hand, glove.port(), true), HasSubstr("channel 4 (index_mcp) at 2.2"));
  hand.board_port = glove.port();
  EXPECT_THAT(findings(hand, glove.port(), false), HasSubstr("nothing arrives from the measuring board"));
}

TEST(DynamixelCheck, SaysWhichPortIsNone) {
  EXPECT_THAT(findings(two_servos(), "/dev/ttyUSB99", false), HasSubstr("/dev/ttyUSB99: there is no such port"));
  EXPECT_THAT(findings(two_servos(), "/dev/null", false), HasSubstr("no serial port"));
}

TEST(DynamixelCheck, FindsServosAtAnotherBaudRate) {
  DynamixelHand slow = two_servos();
  slow.baud_rate = 57600;  // of the factory
  const DynamixelEmulator glove(slow, open_hand());
  DynamixelHand hand = two_servos();
  hand.patience = std::chrono::milliseconds(5);  // 253 ids are asked
  EXPECT_THAT(
      findings(hand, glove.port(), false),
      AllOf(HasSubstr("servo 1 does not answer"), HasSubstr("the servos answer at 57600 baud: use --baud 57600")));
}

TEST(DynamixelCheck, FindsServosWithOtherIds) {
  DynamixelHand other = two_servos();
  other.servos[1].id = 7;
  const DynamixelEmulator glove(other, open_hand());
  DynamixelHand hand = two_servos();
  hand.patience = std::chrono::milliseconds(5);
  EXPECT_THAT(findings(hand, glove.port(), false),
              AllOf(HasSubstr("servo 2 does not answer"), Not(HasSubstr("servo 1 does not answer")),
                    HasSubstr("lacks servos that answer: 7")));
}

TEST(DynamixelCheck, NamesAnotherModelAndAnImpossibleAngle) {
  DynamixelHand other = two_servos();
  other.model = "XC330-M288";
  const DynamixelEmulator glove(other, open_hand());
  DynamixelHand hand = two_servos();
  hand.servos[1].zero = 1.0;
  EXPECT_THAT(findings(hand, glove.port(), false),
              AllOf(HasSubstr("is an XC330-M288, but the configuration says XL330-M288"),
                    HasSubstr("no such joint turns so far (-10.0° to 90.0°)")));
}

}  // namespace
}  // namespace glissade::bridges

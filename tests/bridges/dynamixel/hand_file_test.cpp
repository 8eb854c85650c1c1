/// Configuration files of gloves of servos.

#include <gtest/gtest.h>

#include <glissade/bridges/dynamixel_hand.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace glissade::bridges {
namespace {

using test_support::expect_bad_input;

constexpr const char* kTwoFingers = R"(name: my glove
model: XC330-M181
baud_rate: 1000000
period_s: 0.004
watchdog_s: 0.1
board_port: /dev/ttyUSB1
servos:
  - {id: 3, joint: index_dip, ratio: -0.5, zero_rad: 1.25, max_current_A: 0.3}
  - {id: 4, joint: middle_dip}
measured:
  - {channel: 5, joint: index_pip, ratio: 2, zero_rad: 0.5}
)";

/// The file with another text in place of one of its own.
void expect_refusal(const std::string& own, const std::string& other, const std::vector<std::string>& parts) {
  std::string text = kTwoFingers;
  text.replace(text.find(own), own.size(), other);
  expect_bad_input([&] { parse_dynamixel_hand(text, "glove.yaml"); }, parts);
}

TEST(DynamixelHandFile, HasAllNumbersOfAGlove) {
  const DynamixelHand hand = parse_dynamixel_hand(kTwoFingers, "glove.yaml");
  EXPECT_EQ(hand.model, "XC330-M181");
  EXPECT_EQ(hand.baud_rate, 1e6);
  EXPECT_EQ(hand.period, std::chrono::milliseconds(4));
  EXPECT_EQ(hand.watchdog, std::chrono::milliseconds(100));
  EXPECT_EQ(hand.board_port, "/dev/ttyUSB1");
  ASSERT_EQ(hand.servos.size(), 2U);
  EXPECT_EQ(hand.servos[0].id, 3);
  EXPECT_EQ(hand.servos[0].joint, 6);
  EXPECT_EQ(hand.servos[0].ratio, -0.5);
  EXPECT_EQ(hand.servos[0].zero, 1.25);
  EXPECT_EQ(hand.servos[0].max_current, 0.3);
  EXPECT_EQ(hand.servos[1].ratio, 1.0) << "by default";
  ASSERT_EQ(hand.measured.size(), 1U);
  EXPECT_EQ(hand.measured[0].channel, 5);
  EXPECT_EQ(hand.measured[0].ratio, 2.0);
}

TEST(DynamixelHandFile, MistakesAreNamedWithTheirLine) {
  expect_refusal("baud_rate", "baudrate", {"glove.yaml:3", "baudrate"});
  expect_refusal("index_dip", "index_tip", {"glove.yaml:8", "index_tip", "did you mean 'index_pip'"});
  expect_refusal("id: 4", "id: 253", {"glove.yaml:9", "servo 253", "0 to 252"});
  expect_refusal("id: 4", "id: 3", {"glove.yaml", "two servos have the id 3"});
  expect_refusal("id: 4", "id: 3.5", {"glove.yaml:9", "id: must be a whole number"});
  expect_refusal("ratio: -0.5", "ratio: 0", {"glove.yaml:8", "ratio must be"});
  expect_refusal("channel: 5", "channel: 16", {"glove.yaml:11", "channel 16", "0 to 15"});
  expect_refusal("index_pip", "index_dip", {"glove.yaml:11", "index_dip", "two servos or channels"});
  expect_refusal("watchdog_s: 0.1", "watchdog_s: 5", {"glove.yaml", "watchdog must be from 20 ms"});
  expect_refusal("XC330-M181", "XM430", {"glove.yaml", "no model XM430"});
  expect_refusal("joint: middle_dip", "zero_rad: 1", {"glove.yaml:9", "joint"});
}

TEST(DynamixelHandFile, PresetsAndFilesAreFoundByTheirName) {
  const test_support::TemporaryFolder folder;
  folder.write("mine.yaml", kTwoFingers);
  EXPECT_EQ(read_dynamixel_hand(folder.path("mine.yaml")).name, "my glove");
  EXPECT_EQ(read_dynamixel_hand("doglove").servos.size(), 5U);
  for (const std::string& preset : dynamixel_presets())
    EXPECT_NO_THROW(descriptor_of(read_dynamixel_hand(preset))) << preset;
  expect_bad_input([] { read_dynamixel_hand("dogglove"); }, {"'dogglove' is neither a file nor a preset", "doglove"});
}

}  // namespace
}  // namespace glissade::bridges

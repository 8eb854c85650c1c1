#include "dynamixel/measuring_board.h"

#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "bytes.h"

namespace glissade::bridges::dynamixel {
namespace {

BoardFrame example() {
  BoardFrame frame{.reference_uV = 3'300'000, .time_stamp = 513};
  frame.words[0] = 1;
  frame.words[1] = -2;
  frame.words[15] = 0x7FFFFF;
  return frame;
}

TEST(MeasuringBoard, FrameIsLittleEndianWithASumOfWords) {
  const std::string bytes = encode(example());
  ASSERT_EQ(bytes.size(), kBoardFrameSize);
  EXPECT_EQ(bytes.substr(0, 16), bytes_of("AA 55 00 00 A0 5A 32 00 01 00 00 00 FE FF FF FF"));
  // 0x00325AA0 + 1 - 2 + 0x007FFFFF, the lower half: 0x5A9E.
  EXPECT_EQ(bytes.substr(72), bytes_of("01 02 9E 5A"));
}

TEST(MeasuringBoard, FrameComesBack) {
  BoardDecoder decoder;
  decoder.push(encode(example()) + encode(example()));
  EXPECT_EQ(decoder.next(), example());
  EXPECT_EQ(decoder.next(), example());
  EXPECT_FALSE(decoder.next());
}

TEST(MeasuringBoard, AngleIsTheShareOfTheReferenceVoltage) {
  BoardFrame frame{.reference_uV = 2'500'000};
  frame.words[3] = 0x7FFFFF / 4;  // 1.25 V of 2.5 V
  EXPECT_NEAR(board_angles(frame)[3], std::numbers::pi, 1e-5);
  EXPECT_NEAR(board_angles({.reference_uV = 2'500'000, .words = {board_word(1.25, 2'500'000)}})[0], 1.25, 1e-6);
}

TEST(MeasuringBoard, DamagedFramesAreSkipped) {
  const std::string good = encode(example());
  std::string wrong = good;
  wrong[20] = 1;
  BoardFrame impossible = example();
  impossible.reference_uV = 0;
  BoardFrame head_in_words = example();
  head_in_words.words[4] = 0x000055AA;
  BoardDecoder decoder;
  decoder.push(good.substr(30) + wrong + good.substr(0, 40) + encode(impossible) + bytes_of("AA 55 00") +
               encode(head_in_words) + good);
  EXPECT_EQ(decoder.next(), head_in_words);
  EXPECT_EQ(decoder.next(), example());
  EXPECT_FALSE(decoder.next());
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

/// The lines of OpenGloves gloves, and what must not pass for one.

#include "opengloves/line_codec.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace glissade::bridges {
namespace {

using enum OpenGlovesEncoding;

constexpr const char* kAlphaLine = "A10B20C30D40E4095F2047G2048P0";
constexpr const char* kLegacyLine = "10&20&30&40&1023&511&512&0&1&0&0&1&0";

TEST(AlphaLine, HasTheFlexionOfAllFingers) {
  const auto line = decode_line("A10B20C30D40E4095F2047G2048P0");
  ASSERT_TRUE(line);
  EXPECT_EQ(line->encoding, kAlpha);
  EXPECT_EQ(line->flexion, (FingerNumbers{10, 20, 30, 40, 4095}));
  EXPECT_EQ(line->joystick, 2047);
  EXPECT_FALSE(line->grab);
}

TEST(AlphaLine, MayHaveButtonsSplayAndSingleJoints) {
  const auto line = decode_line("A1B2C3D4E5F6G7P8HIJKLMNO(AB)9(BB)10(AAC)11");
  ASSERT_TRUE(line);
  EXPECT_EQ(line->flexion, (FingerNumbers{1, 2, 3, 4, 5}));
  EXPECT_TRUE(line->grab);
  EXPECT_EQ(line->numbers, 11);
}

TEST(LegacyLine, HasThirteenNumbers) {
  const auto line = decode_line("10&20&30&40&1023&511&512&0&1&0&0&1&0");
  ASSERT_TRUE(line);
  EXPECT_EQ(line->encoding, kLegacy);
  EXPECT_EQ(line->flexion, (FingerNumbers{10, 20, 30, 40, 1023}));
  EXPECT_EQ(line->joystick, 511);
  EXPECT_TRUE(line->grab);
}

TEST(Line, IsRefusedIfItIsNotWholeOrNotAGloves) {
  const std::vector<std::string> bad{"",
                                     "A",
                                     "A1",
                                     "A1B2C3D4",                            // no little finger
                                     "095B2C3D4E5F6G7P8",                   // the head is lost
                                     "A1B2C3D4E5F6G7P8A1B2C3D4E5F6G7P8",    // a line break is lost
                                     "A1B2C3D4E",                           // the number is lost
                                     "A-1B2C3D4E5",                         //
                                     "A1.5B2C3D4E5",                        //
                                     "A99999999999B2C3D4E5",                //
                                     "A65536B2C3D4E5",                      //
                                     "A1B2C3D4E5 ",                         //
                                     "a1b2c3d4e5",                          //
                                     "A1B2C3D4E5Q6",                        // no such key
                                     "A1B2C3D4E5H6",                        // a button has no number
                                     "A1B2C3D4E5(AB",                       //
                                     "A1B2C3D4E5(AB)",                      //
                                     "A1B2C3D4E5(a)1",                      //
                                     "A1B2C3D4E5()",                        //
                                     "1&2&3&4&5",                           // an echo of limits
                                     "1&2&3&4&5&6&7&8&9&10&11&12",          //
                                     "1&2&3&4&5&6&7&8&9&10&11&12&13&14",    //
                                     "1&2&3&4&5&6&7&8&9&10&11&12&",         //
                                     "1&2&3&4&&6&7&8&9&10&11&12&13",        //
                                     "1&2&3&4&-5&6&7&8&9&10&11&12&13",      //
                                     "rst:0x1 (POWERON_RESET),boot:0x13"};  // a board starts
  for (const std::string& line : bad)
    EXPECT_FALSE(decode_line(line)) << line;
}

TEST(LimitLine, HasAllFingersInTheEncodingOfTheGlove) {
  EXPECT_EQ(limit_line(kAlpha, {0, 250, 1000, 7, 0}), "A0B250C1000D7E0\n");
  EXPECT_EQ(limit_line(kLegacy, {0, 250, 1000, 7, 0}), "0&250&1000&7&0\n");
}

TEST(LimitLine, IsWhatTheFirmwareUnderstands) {
  for (const auto encoding : {kAlpha, kLegacy}) {
    std::string line = limit_line(encoding, {1, 2, 3, 4, 1000});
    line.pop_back();
    EXPECT_EQ(decode_limits(encoding, line), (FingerNumbers{1, 2, 3, 4, 1000}));
    EXPECT_FALSE(decode_limits(encoding == kAlpha ? kLegacy : kAlpha, line)) << "another firmware";
  }
  EXPECT_FALSE(decode_limits(kAlpha, "A0B0")) << "four letters are ignored";
  EXPECT_FALSE(decode_limits(kAlpha, "A0B0C0D0"));
}

TEST(Decoder, FindsLinesInBytesAsTheyCome) {
  const std::string text = std::string(kAlphaLine) + "\n" + kAlphaLine + "\r\n";
  GloveDecoder decoder;
  int states = 0;
  for (const char byte : text)
    states += decoder.take({&byte, 1}) ? 1 : 0;
  EXPECT_EQ(states, 2);
  EXPECT_EQ(decoder.states(), 2);
}

TEST(Decoder, GivesTheNewestOfSeveralStates) {
  GloveDecoder decoder;
  const auto newest = decoder.take("A1B1C1D1E1\nA2B2C2D2E2\nA3B3");
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->flexion[0], 2);
  EXPECT_FALSE(decoder.take("C3")) << "not at its end yet";
  EXPECT_EQ(decoder.take("D3E3\n")->flexion[0], 3);
}

TEST(Decoder, BeginsInTheMiddleOfALine) {
  GloveDecoder decoder;
  EXPECT_FALSE(decoder.take("47G2047P0\n"));
  EXPECT_TRUE(decoder.take(std::string(kAlphaLine) + "\n"));
  EXPECT_EQ(decoder.refused(), 1);
  EXPECT_EQ(decoder.last_refused(), "47G2047P0");
}

TEST(Decoder, DropsLinesWithoutEnd) {
  GloveDecoder decoder;
  for (int i = 0; i < 10000; ++i)
    EXPECT_FALSE(decoder.take("A1B1C1D1E1F1G1P1"));
  EXPECT_FALSE(decoder.take("\n")) << "the end of what was too long";
  EXPECT_TRUE(decoder.take(std::string(kLegacyLine) + "\n"));
}

TEST(Decoder, IgnoresEchoesOfLimits) {
  GloveDecoder decoder;
  ASSERT_TRUE(decoder.take(std::string(kAlphaLine) + "\n"));
  EXPECT_FALSE(decoder.take(limit_line(kAlpha, {0, 0, 500, 0, 0})));
  EXPECT_FALSE(decoder.take("A10B20C30D40E4\n")) << "a line that has lost its tail";
  EXPECT_TRUE(decoder.take(std::string(kAlphaLine) + "\n"));
}

TEST(Decoder, GetsUsedToAnotherGlove) {
  GloveDecoder decoder;
  ASSERT_TRUE(decoder.take("A1B2C3D4E5F6G7P8(AB)9\n"));
  int lines = 1;
  while (!decoder.take("A1B2C3D4E5F6G7P8\n") && lines < 100)
    ++lines;
  EXPECT_EQ(lines, 20);
  EXPECT_TRUE(decoder.take("A1B2C3D4E5F6G7P8\n"));
}

TEST(Decoder, TakesWhatTheEmulatorSays) {
  for (const auto encoding : {kAlpha, kLegacy}) {
    GloveDecoder decoder;
    const auto line = decoder.take(state_line(encoding, {0, 1, 2, 3, 4095}, 4095));
    ASSERT_TRUE(line);
    EXPECT_EQ(line->encoding, encoding);
    EXPECT_EQ(line->flexion, (FingerNumbers{0, 1, 2, 3, 4095}));
  }
}

}  // namespace
}  // namespace glissade::bridges

/// The table of registers, and the sentences of errors.

#include "dynamixel/registers.h"

#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "bytes.h"
#include "dynamixel/status.h"

namespace glissade::bridges::dynamixel {
namespace {

TEST(DynamixelRegisters, AscendWithoutOverlap) {
  std::size_t end = 0;
  for (const Register& one : kRegisters) {
    EXPECT_GE(one.address, end) << one.name;
    end = one.address + one.size;
  }
  EXPECT_LE(end, kTableSize);
}

TEST(DynamixelRegisters, ValuesAreLittleEndianAndSigned) {
  EXPECT_EQ(encode_register(kGoalPosition, 512), bytes_of("00 02 00 00"));
  EXPECT_EQ(encode_register(kGoalPosition, -1), bytes_of("FF FF FF FF"));
  EXPECT_EQ(decode_register(kPresentPosition, bytes_of("FE FF FF FF")), -2);
  EXPECT_EQ(decode_register(kPresentCurrent, bytes_of("0C FE")), -500);
  EXPECT_EQ(decode_register(kModelNumber, bytes_of("B0 04")), 1200);
  EXPECT_EQ(decode_register(kBusWatchdog, bytes_of("FF")), kWatchdogExpired);
}

TEST(DynamixelRegisters, ValuesAreClampedToTheirBytes) {
  EXPECT_EQ(encode_register(kGoalCurrent, 40000), bytes_of("FF 7F"));
  EXPECT_EQ(encode_register(kGoalCurrent, -40000), bytes_of("00 80"));
  EXPECT_EQ(encode_register(kTorqueEnable, -1), bytes_of("00"));
}

TEST(DynamixelRegisters, UnitsAreSI) {
  EXPECT_EQ(to_counts(kGoalPosition, std::numbers::pi), 2048);
  EXPECT_EQ(to_counts(kGoalCurrent, 0.25), 250);
  EXPECT_EQ(to_counts(kBusWatchdog, 0.06), 3);
  EXPECT_NEAR(100 * kPresentVelocity.unit, 22.9 * 2.0 * std::numbers::pi / 60.0, 1e-9);
}

TEST(DynamixelModels, AreFoundByNameAndNumber) {
  EXPECT_EQ(find_model("XL330-M288")->number, 1200);
  EXPECT_EQ(find_model(std::uint16_t{1240})->name, "XC330-M288");
  EXPECT_FALSE(find_model("XM430-W350"));
  EXPECT_NEAR(torque_per_current(*find_model("XC330-M288")), 0.517, 1e-3) << "of the data sheet";
}

TEST(DynamixelStatus, ErrorsAreSentences) {
  EXPECT_EQ(to_text(error_number(0)), "");
  EXPECT_EQ(to_text(error_number(0x86)), "the value exceeds the servo's limit");
  EXPECT_TRUE(has_alert(0x86));
  EXPECT_EQ(to_text(StatusError{99}), "the servo reports the unknown error 99");
  EXPECT_EQ(hardware_error_text(kOverloadError), "it was overloaded for too long; lower the largest current");
  EXPECT_EQ(hardware_error_text(kEncoderError | 0x40),
            "its position sensor is broken; also it reports the unknown hardware error 64");
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

/// Packets, compared with the worked examples of the protocol's documentation
/// (emanual.robotis.com/docs/en/dxl/protocol2).

#include "dynamixel/packet.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bytes.h"

namespace glissade::bridges::dynamixel {
namespace {

struct Example {
  const char* what;
  Packet packet;
  std::string bytes;
};

std::vector<Example> examples() {
  const auto text = [](const char* hexadecimal) { return bytes_of(hexadecimal); };
  return {
      {"ping 1", {1, Instruction::kPing, {}}, text("FF FF FD 00 01 03 00 01 19 4E")},
      {"ping all", {kBroadcastId, Instruction::kPing, {}}, text("FF FF FD 00 FE 03 00 01 31 42")},
      {"answer of 1 to a ping: model 1030, firmware 38",
       {1, Instruction::kStatus, text("00 06 04 26")},
       text("FF FF FD 00 01 07 00 55 00 06 04 26 65 5D")},
      {"answer of 2",
       {2, Instruction::kStatus, text("00 06 04 26")},
       text("FF FF FD 00 02 07 00 55 00 06 04 26 6F 6D")},
      {"read the present position",
       {1, Instruction::kRead, text("84 00 04 00")},
       text("FF FF FD 00 01 07 00 02 84 00 04 00 1D 15")},
      {"answer: 166",
       {1, Instruction::kStatus, text("00 A6 00 00 00")},
       text("FF FF FD 00 01 08 00 55 00 A6 00 00 00 8C C0")},
      {"write 512 to the goal position",
       {1, Instruction::kWrite, text("74 00 00 02 00 00")},
       text("FF FF FD 00 01 09 00 03 74 00 00 02 00 00 CA 89")},
      {"answer: done", {1, Instruction::kStatus, text("00")}, text("FF FF FD 00 01 04 00 55 00 A1 0C")},
      {"restart", {1, Instruction::kReboot, {}}, text("FF FF FD 00 01 03 00 08 2F 4E")},
      {"read the present positions of 1 and 2",
       {kBroadcastId, Instruction::kSyncRead, text("84 00 04 00 01 02")},
       text("FF FF FD 00 FE 09 00 82 84 00 04 00 01 02 CE FA")},
      {"write 150 and 170 to the goal positions of 1 and 2",
       {kBroadcastId, Instruction::kSyncWrite, text("74 00 04 00 01 96 00 00 00 02 AA 00 00 00")},
       text("FF FF FD 00 FE 11 00 83 74 00 04 00 01 96 00 00 00 02 AA 00 00 00 82 87")},
      {"one answer of 3, 7 and 4 to a fast read",
       {kBroadcastId, Instruction::kStatus, text("00 03 A6 00 00 00 84 08 00 07 1F 08 00 00 16 CA 00 04 FF 03 00 00")},
       text("FF FF FD 00 FE 19 00 55 00 03 A6 00 00 00 84 08 00 07 1F 08 00 00 16 CA 00 04 FF 03 00 00 D1 9E")},
  };
}

std::vector<Packet> all_of(PacketDecoder& decoder) {
  std::vector<Packet> packets;
  while (std::optional<Packet> packet = decoder.next())
    packets.push_back(*packet);
  return packets;
}

std::vector<Packet> decoded(const std::string& bytes) {
  PacketDecoder decoder;
  decoder.push(bytes);
  return all_of(decoder);
}

TEST(DynamixelPacket, EncodesTheDocumentedExamples) {
  for (const Example& example : examples())
    EXPECT_EQ(encode(example.packet), example.bytes) << example.what;
}

TEST(DynamixelPacket, DecodesTheDocumentedExamplesByteByByte) {
  PacketDecoder decoder;
  for (const Example& example : examples()) {
    for (const char byte : example.bytes.substr(0, example.bytes.size() - 1)) {
      decoder.push({&byte, 1});
      ASSERT_FALSE(decoder.next()) << example.what;
    }
    decoder.push(example.bytes.substr(example.bytes.size() - 1));
    EXPECT_EQ(decoder.next(), example.packet) << example.what;
  }
  EXPECT_EQ(decoder.skipped_bytes(), 0U);
}

TEST(DynamixelPacket, BlocksOfAFastAnswerEndWithTheChecksumSoFar) {
  const std::string whole = examples().back().bytes;
  EXPECT_EQ(crc16(whole.substr(0, 14)), 0x0884);
  EXPECT_EQ(crc16(whole.substr(0, 22)), 0xCA16);
}

TEST(DynamixelPacket, StuffingKeepsTheHeadOutOfTheContent) {
  const Packet packet{1, Instruction::kWrite, bytes_of("74 00 FF FF FD 00 FF FF FD FD 12")};
  const std::string bytes = encode(packet);
  EXPECT_EQ(bytes.substr(8, 13), bytes_of("74 00 FF FF FD FD 00 FF FF FD FD FD 12"));
  EXPECT_EQ(static_cast<unsigned char>(bytes[5]), 3U + 13U) << "the length counts the stuffing";
  EXPECT_EQ(bytes.find(bytes_of("FF FF FD 00"), 1), std::string::npos);
  EXPECT_EQ(decoded(bytes), std::vector{packet});
}

TEST(DynamixelPacket, AnyContentComesBack) {
  std::mt19937 random(7);
  const std::string common = bytes_of("FF FF FD 00 01");
  for (int round = 0; round < 2000; ++round) {
    Packet packet{static_cast<std::uint8_t>(random() % 253), Instruction::kStatus, {}};
    for (std::size_t i = random() % 30; i > 0; --i)
      packet.parameters.push_back(common[random() % common.size()]);
    ASSERT_EQ(decoded(encode(packet)), std::vector{packet}) << "round " << round;
  }
}

TEST(DynamixelPacket, StuffingCountsTheInstruction) {
  const Packet packet{1, Instruction{0xFF}, bytes_of("FF FD 00")};
  EXPECT_EQ(decoded(encode(packet)), std::vector{packet});
}

class DamagedLine : public testing::Test {
 protected:
  const Packet packet_{1, Instruction::kStatus, bytes_of("00 A6 00 00 00")};
  const std::string bytes_ = encode(packet_);
};

TEST_F(DamagedLine, GarbageIsSkipped) {
  EXPECT_EQ(decoded(bytes_of("00 FF FF FD FF 12 FF FF") + bytes_), std::vector{packet_});
}

TEST_F(DamagedLine, HeadInGarbageIsSkipped) {
  EXPECT_EQ(decoded(bytes_of("FF FF FD 00 03 05 00") + bytes_), std::vector{packet_}) << "a short packet";
  EXPECT_EQ(decoded(bytes_of("FF FF FD 00 03 FF FF") + bytes_), std::vector{packet_}) << "an impossible length";
  EXPECT_EQ(decoded(bytes_of("FF FF FD 00 03 00 00") + bytes_), std::vector{packet_}) << "a length of nothing";
}

TEST_F(DamagedLine, PacketAfterACutPacketIsFoundAtOnce) {
  const std::string long_one = encode({2, Instruction::kStatus, std::string(60, 'x')});
  for (std::size_t size = 1; size < long_one.size(); ++size)
    EXPECT_EQ(decoded(long_one.substr(0, size) + bytes_), std::vector{packet_}) << "after " << size << " bytes";
}

TEST_F(DamagedLine, EachWrongBitIsNoticed) {
  for (std::size_t bit = 0; bit < 8 * bytes_.size(); ++bit) {
    std::string damaged = bytes_;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ static_cast<char>(1U << bit % 8));
    PacketDecoder decoder;
    decoder.push(damaged);
    EXPECT_FALSE(decoder.next()) << "bit " << bit;
  }
}

TEST_F(DamagedLine, WrongChecksumsAreCounted) {
  PacketDecoder decoder;
  std::string damaged = bytes_;
  damaged.back() = static_cast<char>(damaged.back() ^ 1);
  decoder.push(damaged + bytes_);
  EXPECT_EQ(all_of(decoder), std::vector{packet_});
  EXPECT_EQ(decoder.wrong_checksums(), 1U);
  EXPECT_EQ(decoder.skipped_bytes(), damaged.size());
}

TEST_F(DamagedLine, ClearForgetsHalfAPacket) {
  PacketDecoder decoder;
  decoder.push(bytes_.substr(0, 9));
  EXPECT_FALSE(decoder.next());
  decoder.clear();
  decoder.push(bytes_);
  EXPECT_EQ(decoder.next(), packet_);
}

}  // namespace
}  // namespace glissade::bridges::dynamixel

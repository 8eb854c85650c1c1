#include "lcm/lcm_packet.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace glissade::devices {
namespace {

std::vector<std::uint8_t> packet_bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

const std::string kHeadOfSmallMessage("LC02\0\0\0\x01", 8);

TEST(LcmPacket, HasAChannelAndAMessage) {
  const auto bytes = packet_bytes(kHeadOfSmallMessage + std::string("GLOVE_STATE\0abc", 15));
  const auto packet = parse_packet(bytes);
  ASSERT_TRUE(packet.has_value());
  EXPECT_EQ(packet->channel, "GLOVE_STATE");
  EXPECT_EQ(std::string(packet->message.begin(), packet->message.end()), "abc");
}

TEST(LcmPacket, MayHaveAnEmptyMessage) {
  const auto bytes = packet_bytes(kHeadOfSmallMessage + std::string("A\0", 2));
  ASSERT_TRUE(parse_packet(bytes).has_value());
  EXPECT_TRUE(parse_packet(bytes)->message.empty());
}

TEST(LcmPacket, FragmentIsRefused) {
  const auto bytes = packet_bytes(std::string("LC03\0\0\0\x01", 8) + std::string("GLOVE_STATE\0abc", 15));
  EXPECT_FALSE(parse_packet(bytes).has_value());
}

TEST(LcmPacket, NeedsAChannelThatEnds) {
  EXPECT_FALSE(parse_packet({}).has_value());
  EXPECT_FALSE(parse_packet(packet_bytes("LC02")).has_value());
  EXPECT_FALSE(parse_packet(packet_bytes(kHeadOfSmallMessage)).has_value());
  EXPECT_FALSE(parse_packet(packet_bytes(kHeadOfSmallMessage + "GLOVE_STATE")).has_value());
  EXPECT_FALSE(parse_packet(packet_bytes(kHeadOfSmallMessage + std::string("\0abc", 4))).has_value());
  const std::string sixteen(16, 'A');
  EXPECT_FALSE(parse_packet(packet_bytes(kHeadOfSmallMessage + sixteen + std::string("\0abc", 4))).has_value());
}

}  // namespace
}  // namespace glissade::devices

/// Which messages are refused for their contents.

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glove_link_fixture.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(GloveInfo, InvalidDescriptorIsRefused) {
  DeviceDescriptor descriptor = simulated_glove_descriptor();
  GloveInfo info;
  EXPECT_EQ(decode(encode(GloveInfo{1, 1, hands::HandSide::kRight, descriptor}), info), MessageError::kNone);
  descriptor.max_force = kNan;
  EXPECT_EQ(decode(encode(GloveInfo{1, 1, hands::HandSide::kRight, descriptor}), info), MessageError::kOutOfRange);
  descriptor.max_force = 20.0;
  descriptor.update_rate = 1e-300;
  EXPECT_EQ(decode(encode(GloveInfo{1, 1, hands::HandSide::kRight, descriptor}), info), MessageError::kOutOfRange);
}

TEST_F(LcmLink, RefusesMessagesOfTheWrongSize) {
  const Bytes good = encoded(good_state(1));
  for (std::size_t size = 0; size < good.size(); size += 13) {
    EXPECT_EQ(after(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))).accepted, 0U) << size;
  }
  Bytes longer = good;
  longer.push_back(0);
  const LinkStatistics statistics = after(longer);
  EXPECT_EQ(statistics.accepted, 0U);
  EXPECT_EQ(statistics.wrong_size, statistics.rejected());
}

TEST_F(LcmLink, RefusesAnotherTypeOfTheSameSize) {
  Bytes bytes = encoded(good_state(1));
  bytes[3] = static_cast<std::uint8_t>(bytes[3] ^ 1U);  // the first eight bytes tell the type
  EXPECT_EQ(after(bytes).undecodable, 1U);
}

TEST_F(LcmLink, RefusesAnotherVersion) {
  glove_state_t message = good_state(1);
  ++message.version;
  EXPECT_EQ(after(encoded(message)).wrong_version, 1U);
}

TEST_F(LcmLink, RefusesNonFiniteNumbers) {
  const std::function<void(glove_state_t&)> spoilers[] = {[](glove_state_t& m) { m.position_WH_m[1] = kNan; },
                                                          [](glove_state_t& m) { m.orientation_WH_wxyz[0] = kNan; },
                                                          [](glove_state_t& m) { m.v_WH_m_per_s[2] = -kInfinity; },
                                                          [](glove_state_t& m) { m.w_WH_rad_per_s[0] = kInfinity; },
                                                          [](glove_state_t& m) { m.joint_angles_rad[21] = kNan; }};
  std::uint64_t refused = 0;
  for (const auto& spoil : spoilers) {
    glove_state_t message = good_state(1);
    spoil(message);
    EXPECT_EQ(after(encoded(message)).not_finite, ++refused);
  }
  GloveState state;
  EXPECT_FALSE(glove.read(state));
}

TEST_F(LcmLink, RefusesNumbersOutOfRange) {
  const std::function<void(glove_state_t&)> spoilers[] = {[](glove_state_t& m) { m.sequence = -1; },
                                                          [](glove_state_t& m) { m.time_ns = -1; },
                                                          [](glove_state_t& m) { m.time_ns = kLargest; },
                                                          [](glove_state_t& m) { m.session = -1; },
                                                          [](glove_state_t& m) { m.leaseholder = -1; },
                                                          [](glove_state_t& m) { m.side = 3; },
                                                          [](glove_state_t& m) { m.enabled = 2; },
                                                          [](glove_state_t& m) { m.position_WH_m[2] = 1001.0; },
                                                          [](glove_state_t& m) { m.orientation_WH_wxyz[0] = 0.0; },
                                                          [](glove_state_t& m) { m.orientation_WH_wxyz[0] = 1.0011; },
                                                          [](glove_state_t& m) { m.v_WH_m_per_s[0] = -1001.0; },
                                                          [](glove_state_t& m) { m.w_WH_rad_per_s[1] = 1e5; },
                                                          [](glove_state_t& m) { m.joint_angles_rad[0] = 6.3; }};
  std::uint64_t refused = 0;
  for (const auto& spoil : spoilers) {
    glove_state_t message = good_state(1);
    spoil(message);
    EXPECT_EQ(after(encoded(message)).out_of_range, ++refused);
  }
}

TEST_F(LcmLink, NamesTheFirstFieldOfEachKindOfRefusal) {
  Bytes short_one = encoded(good_state(1));
  short_one.resize(12);
  after(short_one);
  const auto spoil = [&](auto change) {
    glove_state_t message = good_state(1);
    change(message);
    after(encoded(message));
  };
  spoil([](glove_state_t& m) { m.version = 7; });
  spoil([](glove_state_t& m) { m.position_WH_m[1] = kNan; });
  spoil([](glove_state_t& m) { m.orientation_WH_wxyz[0] = 1.5; });
  spoil([](glove_state_t& m) { m.position_WH_m[0] = kInfinity; });  // a second one of its kind
  spoil([](glove_state_t& m) { m.side = 3; });
  const std::string size = std::to_string(encoded(good_state(1)).size());
  EXPECT_THAT(refusals_of(glove.statistics()),
              testing::ElementsAre(
                  "they are not of the type that this program knows: the number of bytes is 12, not " + size,
                  "they have another version of the type: version is 7, not " + std::to_string(good_state(1).version),
                  "a number is not finite: position_WH_m[1] is nan",
                  "a number is out of its range: the norm of orientation_WH_wxyz is 1.5, not 1"));
}

TEST_F(LcmLink, NamesAFieldOutOfItsRange) {
  glove_state_t message = good_state(1);
  message.side = 3;
  after(encoded(message));
  EXPECT_THAT(refusals_of(glove.statistics()), testing::ElementsAre("a number is out of its range: side is 3"));
}

TEST_F(LcmLink, NormalizesAQuaternionThatIsNearlyOne) {
  glove_state_t message = good_state(1);
  message.orientation_WH_wxyz[0] = 0.9995;
  EXPECT_EQ(after(encoded(message)).accepted, 1U);
  GloveState state;
  ASSERT_TRUE(glove.read(state));
  EXPECT_TRUE(state.X_WH.linear().isIdentity(1e-15));
}

}  // namespace
}  // namespace glissade::devices

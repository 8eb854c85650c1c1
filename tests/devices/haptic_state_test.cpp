// The telemetry of a tick, there and back over the wire, and what a receiver makes of numbers it does not know.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <glissade/devices/haptic_state.h>
#include <glissade/lcmtypes/haptic_state_t.hpp>

#include "lcm/glove_messages.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

HapticState some_state() {
  HapticState state;
  state.sequence = 12;
  state.time = milliseconds(34);
  state.X_WG = Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(0.5, Vector3d::UnitX());
  state.X_WV = Eigen::Translation3d(4.0, 5.0, 6.0) * Eigen::AngleAxisd(0.6, Vector3d::UnitY());
  state.force_on_hand_W = Vector3d(7.0, 8.0, 9.0);
  state.torque_on_hand_V_W = Vector3d(10.0, 11.0, 12.0);
  state.part_state = PartState::kCatchingUp;
  state.contact_count = 3;
  state.contact_set_age = milliseconds(2);
  state.are_contacts_unsolved = true;
  state.contact_share = 0.25;
  state.energy = 0.125;
  state.glove_energy = 0.5;
  state.reasons.is_state_old = true;
  state.reasons.mean_limited = true;
  state.state_age = milliseconds(14);
  return state;
}

haptic_state_t message_of(const HapticState& state) {
  const auto bytes = encode(state);
  haptic_state_t message{};
  EXPECT_GT(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  return message;
}

MessageError decoded(const haptic_state_t& message, HapticState& state) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return decode(bytes, state);
}

TEST(HapticState, ArrivesAsItWasSent) {
  const HapticState sent = some_state();
  HapticState received;
  ASSERT_EQ(decode(encode(sent), received), MessageError::kNone);
  EXPECT_EQ(received.sequence, sent.sequence);
  EXPECT_EQ(received.time, sent.time);
  EXPECT_TRUE(received.X_WG.isApprox(sent.X_WG));
  EXPECT_TRUE(received.X_WV.isApprox(sent.X_WV));
  EXPECT_EQ(received.force_on_hand_W, sent.force_on_hand_W);
  EXPECT_EQ(received.torque_on_hand_V_W, sent.torque_on_hand_V_W);
  EXPECT_EQ(received.part_state, PartState::kCatchingUp);
  EXPECT_EQ(received.contact_count, 3);
  EXPECT_EQ(received.contact_set_age, sent.contact_set_age);
  EXPECT_FALSE(received.is_in_contact);
  EXPECT_TRUE(received.are_contacts_unsolved);
  EXPECT_EQ(received.contact_share, 0.25);
  EXPECT_EQ(received.energy, 0.125);
  EXPECT_EQ(received.glove_energy, 0.5);
  EXPECT_FALSE(received.is_contact_set_late);
  EXPECT_TRUE(received.reasons.is_state_old && received.reasons.mean_limited);
  EXPECT_FALSE(received.reasons.is_stopped || received.reasons.is_returning);
  EXPECT_EQ(received.state_age, milliseconds(14));
}

TEST(HapticState, EveryStateOfThePartHasItsNumberAndName) {
  EXPECT_EQ(part_state_from_number(haptic_state_t::PART_RELEASED), PartState::kReleased);
  EXPECT_EQ(part_state_from_number(haptic_state_t::PART_FREE), PartState::kFree);
  EXPECT_EQ(part_state_from_number(haptic_state_t::PART_SLIDING), PartState::kSliding);
  EXPECT_EQ(part_state_from_number(haptic_state_t::PART_RESTING), PartState::kResting);
  EXPECT_EQ(part_state_from_number(haptic_state_t::PART_CATCHING_UP), PartState::kCatchingUp);
  for (std::int32_t number = 1; number < kPartStates; ++number)
    EXPECT_NE(name_of(part_state_from_number(number)), "unknown") << number;
}

TEST(HapticState, AStateOfANewerSimulationIsUnknownAndNoError) {
  for (const std::int32_t number : {-1, 0, kPartStates, std::numeric_limits<std::int32_t>::max()}) {
    haptic_state_t message = message_of(some_state());
    message.part_state = number;
    HapticState received;
    ASSERT_EQ(decoded(message, received), MessageError::kNone);
    EXPECT_EQ(received.part_state, PartState::kUnknown) << number;
    EXPECT_EQ(name_of(received.part_state), "unknown");
  }
}

TEST(HapticState, WhatCannotBeIsRefusedAndChangesNothing) {
  HapticState received;
  haptic_state_t message = message_of(some_state());
  message.force_on_hand_W_N[1] = std::nan("");
  EXPECT_EQ(decoded(message, received), MessageError::kNotFinite);
  message = message_of(some_state());
  message.orientation_WV_wxyz[0] = 3.0;
  EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange);
  message = message_of(some_state());
  message.contact_count = -1;
  EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange);
  auto bytes = encode(some_state());
  bytes.pop_back();
  EXPECT_EQ(decode(bytes, received), MessageError::kWrongSize);
  message = message_of(some_state());
  ++message.version;
  EXPECT_EQ(decoded(message, received), MessageError::kWrongVersion);
  EXPECT_EQ(received.sequence, 0);
}

}  // namespace
}  // namespace glissade::devices

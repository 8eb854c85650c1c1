// The telemetry of a tick, there and back over the wire, and what a receiver makes of numbers it does not know.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <glissade/devices/haptic_state.h>
#include <glissade/lcmtypes/haptic_hand_t.hpp>
#include <glissade/lcmtypes/haptic_part_t.hpp>
#include <glissade/lcmtypes/haptic_patch_t.hpp>
#include <glissade/lcmtypes/haptic_state_t.hpp>

#include "lcm/haptic_state_message.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

HapticState some_state() {
  HapticState state;
  state.sequence = 12;
  state.time = milliseconds(34);
  state.contact_set_age = milliseconds(2);
  state.lateness = milliseconds(3);
  state.last_duration = milliseconds(1);
  state.part_count = 3;
  state.hand_count = 2;
  state.contact_count = 1;
  state.contacts[0] = {2, {0.5F, 0.25F, 0.125F}, Eigen::Vector3f::UnitY()};
  state.patch_count = 1;
  state.patches_left_out = 3;
  state.patches[0] = {2, 4, {0.5F, 0.25F, 0.125F}, Eigen::Vector3f::UnitX(), 0.0625F};
  HapticPartState& part = state.parts[2];
  part.X_WG = Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(0.5, Vector3d::UnitX());
  part.X_WV = Eigen::Translation3d(4.0, 5.0, 6.0) * Eigen::AngleAxisd(0.6, Vector3d::UnitY());
  part.p_Vref = Vector3d(0.25, -0.5, 0.75);
  part.state = PartState::kCatchingUp;
  part.contact_count = 3;
  HapticHandState& hand = state.hands[1];
  hand.part = 2;
  hand.force_W = Vector3d(7.0, 8.0, 9.0);
  hand.torque_V_W = Vector3d(10.0, 11.0, 12.0);
  hand.are_contacts_unsolved = true;
  hand.contact_share = 0.25;
  hand.energy = 0.125;
  hand.glove_energy = 0.5;
  hand.reasons.is_state_old = true;
  hand.reasons.mean_limited = true;
  hand.glove_reasons.is_disabled = true;
  hand.state_age = milliseconds(14);
  hand.command_age = milliseconds(15);
  hand.visible.activity = hands::HandActivity::kHolding;
  hand.visible.grasp = hands::GraspType::kPrecision;
  hand.visible.form = hands::GraspForm::kKey;
  hand.visible.touching = 0x888;
  hand.visible.X_WH = Eigen::Translation3d(0.1, 0.2, 0.3) * Eigen::AngleAxisd(0.7, Vector3d::UnitZ());
  hand.visible.angles[4] = 0.75;
  hand.joint_torques[21] = -0.25;
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
  EXPECT_EQ(received.contact_set_age, sent.contact_set_age);
  EXPECT_FALSE(received.is_contact_set_late);
  EXPECT_EQ(received.part_count, 3);
  EXPECT_EQ(received.hand_count, 2);
  EXPECT_EQ(received.lateness, milliseconds(3));
  EXPECT_EQ(received.last_duration, milliseconds(1));
  ASSERT_EQ(received.contact_count, 1);
  EXPECT_EQ(received.contacts[0].part, 2);
  EXPECT_EQ(received.contacts[0].p_V, sent.contacts[0].p_V);
  EXPECT_EQ(received.contacts[0].n_W, sent.contacts[0].n_W);
  ASSERT_EQ(received.patch_count, 1);
  EXPECT_EQ(received.patches_left_out, 3);
  EXPECT_EQ(received.patches[0].part, 2);
  EXPECT_EQ(received.patches[0].contact_count, 4);
  EXPECT_EQ(received.patches[0].p_V, sent.patches[0].p_V);
  EXPECT_EQ(received.patches[0].n_W, sent.patches[0].n_W);
  EXPECT_EQ(received.patches[0].extent, 0.0625F);
  const HapticPartState& part = received.parts[2];
  EXPECT_TRUE(part.X_WG.isApprox(sent.parts[2].X_WG));
  EXPECT_TRUE(part.X_WV.isApprox(sent.parts[2].X_WV));
  EXPECT_EQ(part.p_Vref, sent.parts[2].p_Vref);
  EXPECT_EQ(part.state, PartState::kCatchingUp);
  EXPECT_EQ(part.contact_count, 3);
  EXPECT_EQ(received.hands[0].part, -1);
  const HapticHandState& hand = received.hands[1];
  EXPECT_EQ(hand.part, 2);
  EXPECT_EQ(hand.force_W, sent.hands[1].force_W);
  EXPECT_EQ(hand.torque_V_W, sent.hands[1].torque_V_W);
  EXPECT_TRUE(hand.are_contacts_unsolved);
  EXPECT_EQ(hand.contact_share, 0.25);
  EXPECT_EQ(hand.energy, 0.125);
  EXPECT_EQ(hand.glove_energy, 0.5);
  EXPECT_TRUE(hand.reasons.is_state_old && hand.reasons.mean_limited);
  EXPECT_FALSE(hand.reasons.is_stopped || hand.reasons.is_returning);
  EXPECT_TRUE(hand.glove_reasons.is_disabled);
  EXPECT_EQ(hand.state_age, milliseconds(14));
  EXPECT_EQ(hand.command_age, milliseconds(15));
  EXPECT_EQ(hand.visible.activity, hands::HandActivity::kHolding);
  EXPECT_EQ(hand.visible.grasp, hands::GraspType::kPrecision);
  EXPECT_EQ(hand.visible.form, hands::GraspForm::kKey);
  EXPECT_EQ(hand.visible.touching, 0x888);
  EXPECT_TRUE(hand.visible.X_WH.isApprox(sent.hands[1].visible.X_WH));
  EXPECT_EQ(hand.visible.angles, sent.hands[1].visible.angles);
  EXPECT_EQ(hand.joint_torques, sent.hands[1].joint_torques);
}

TEST(HapticState, EveryActivityAndGraspHasItsNumberAndName) {
  EXPECT_EQ(static_cast<std::int32_t>(hands::HandActivity::kWaiting), haptic_hand_t::ACTIVITY_WAITING);
  EXPECT_EQ(static_cast<std::int32_t>(hands::HandActivity::kHolding), haptic_hand_t::ACTIVITY_HOLDING);
  EXPECT_EQ(static_cast<std::int32_t>(hands::GraspType::kPower), haptic_hand_t::GRASP_POWER);
  EXPECT_EQ(static_cast<std::int32_t>(hands::GraspForm::kGravity), haptic_hand_t::FORM_GRAVITY);
  for (std::int32_t number = 1; number < hands::kGraspForms; ++number)
    EXPECT_NE(name_of(static_cast<hands::GraspForm>(number)), "") << number;
  for (std::int32_t number = 1; number < hands::kHandActivities; ++number)
    EXPECT_NE(name_of(static_cast<hands::HandActivity>(number)), "none") << number;
  for (std::int32_t number = 1; number < hands::kGraspTypes; ++number)
    EXPECT_NE(name_of(static_cast<hands::GraspType>(number)), "none") << number;
}

TEST(HapticState, UnknownActivityIsDecodedAsNone) {
  haptic_state_t message = message_of(some_state());
  message.hands[1].activity = hands::kHandActivities;
  message.hands[1].grasp = -1;
  message.hands[1].form = hands::kGraspForms;
  HapticState received;
  ASSERT_EQ(decoded(message, received), MessageError::kNone);
  EXPECT_EQ(received.hands[1].visible.activity, hands::HandActivity::kNone);
  EXPECT_EQ(received.hands[1].visible.grasp, hands::GraspType::kNone);
  EXPECT_EQ(received.hands[1].visible.form, hands::GraspForm::kNone);
}

TEST(HapticState, EveryStateOfThePartHasItsNumberAndName) {
  EXPECT_EQ(part_state_from_number(haptic_part_t::PART_RELEASED), PartState::kReleased);
  EXPECT_EQ(part_state_from_number(haptic_part_t::PART_FREE), PartState::kFree);
  EXPECT_EQ(part_state_from_number(haptic_part_t::PART_SLIDING), PartState::kSliding);
  EXPECT_EQ(part_state_from_number(haptic_part_t::PART_RESTING), PartState::kResting);
  EXPECT_EQ(part_state_from_number(haptic_part_t::PART_CATCHING_UP), PartState::kCatchingUp);
  for (std::int32_t number = 1; number < kPartStates; ++number)
    EXPECT_NE(name_of(part_state_from_number(number)), "unknown") << number;
}

TEST(HapticState, UnknownPartStateIsDecodedAsUnknown) {
  for (const std::int32_t number : {-1, 0, kPartStates, std::numeric_limits<std::int32_t>::max()}) {
    haptic_state_t message = message_of(some_state());
    message.parts[2].part_state = number;
    HapticState received;
    ASSERT_EQ(decoded(message, received), MessageError::kNone);
    EXPECT_EQ(received.parts[2].state, PartState::kUnknown) << number;
    EXPECT_EQ(name_of(received.parts[2].state), "unknown");
  }
}

TEST(HapticState, InvalidNumbersAreRefusedAndChangeNothing) {
  HapticState received;
  haptic_state_t message = message_of(some_state());
  message.hands[1].force_W_N[1] = std::nan("");
  EXPECT_EQ(decoded(message, received), MessageError::kNotFinite);
  message = message_of(some_state());
  message.hands[1].joint_angles_rad[3] = 7.0;
  EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange);
  message = message_of(some_state());
  message.parts[3].orientation_WV_wxyz[0] = 3.0;
  EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange);
  message = message_of(some_state());
  message.parts[0].contact_count = -1;
  EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange);
  for (const std::int32_t count : {-1, 5}) {
    message = message_of(some_state());
    message.part_count = count;
    EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange) << count;
    message = message_of(some_state());
    message.hand_count = count;
    EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange) << count;
  }
  for (const std::int32_t part :
       {std::numeric_limits<std::int32_t>::min(), -2, 4, std::numeric_limits<std::int32_t>::max()}) {
    message = message_of(some_state());
    message.hands[0].part = part;
    EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange) << part;
  }
  for (const std::int32_t count : {-1, static_cast<std::int32_t>(kHapticContacts) + 1}) {
    message = message_of(some_state());
    message.contact_count = count;
    EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange) << count;
  }
  message = message_of(some_state());
  message.contacts[0].normal_W[2] = 2.0F;
  EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange);
  for (const std::int32_t count : {-1, static_cast<std::int32_t>(kHapticPatches) + 1}) {
    message = message_of(some_state());
    message.patch_count = count;
    EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange) << count;
  }
  message = message_of(some_state());
  message.patches[7].extent_m = std::nanf("");
  EXPECT_EQ(decoded(message, received), MessageError::kNotFinite);
  message = message_of(some_state());
  message.patches[7].part = 4;
  EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange);
  for (const std::int32_t segments : {-1, 1 << 24}) {
    message = message_of(some_state());
    message.hands[1].touching = segments;
    EXPECT_EQ(decoded(message, received), MessageError::kOutOfRange) << segments;
  }
  auto bytes = encode(some_state());
  bytes.pop_back();
  EXPECT_EQ(decode(bytes, received), MessageError::kWrongSize);
  message = message_of(some_state());
  ++message.version;
  EXPECT_EQ(decoded(message, received), MessageError::kWrongVersion);
  EXPECT_EQ(received.sequence, 0);
}

TEST(EnergyLeft, IsTheGloveEnergyOnceTheGloveReports) {
  HapticHandState hand;
  hand.energy = 0.1;
  hand.glove_energy = 0.02;
  EXPECT_EQ(energy_left(hand), 0.1) << "a glove without an envelope of its own";
  hand.command_age = std::chrono::milliseconds(1);
  EXPECT_EQ(energy_left(hand), 0.02);
}

}  // namespace
}  // namespace glissade::devices

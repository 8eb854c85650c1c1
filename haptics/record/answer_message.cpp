#include <algorithm>
#include <chrono>
#include <cmath>

#include <glissade/lcmtypes/contact_set_t.hpp>

#include "record/message_bytes.h"
#include "record/pose_message.h"
#include "record/record_messages.h"

namespace glissade::haptics {

namespace {

/// Whether a simulation can work on them: bytes that were changed may say anything, and their checksum is looked at
/// later.
bool are_plausible(const Ghosts& ghosts) {
  constexpr double kFarthest_m = 1e6;
  constexpr std::chrono::nanoseconds kLatest{std::int64_t{1} << 60};
  const auto is_plausible = [](const Eigen::Isometry3d& X) {
    return X.matrix().allFinite() && X.translation().cwiseAbs().maxCoeff() <= kFarthest_m;
  };
  return ghosts.time >= std::chrono::nanoseconds(0) && ghosts.time <= kLatest &&
         std::all_of(ghosts.parts.begin(), ghosts.parts.end(),
                     [&](const GhostOfPart& part) { return is_plausible(part.X_WG); }) &&
         std::all_of(ghosts.hands.begin(), ghosts.hands.end(), [&](const GhostOfHand& hand) {
           return is_plausible(hand.X_WH) && std::all_of(hand.angles.begin(), hand.angles.end(),
                                                         [](double angle) { return std::isfinite(angle); });
         });
}

part_answer_t message_of(const PartAnswer& answer) {
  part_answer_t message;
  put(answer.p_Vref.data(), message.p_Vref_m);
  message.X_WV = pose_message(answer.X_WV);
  message.X_WV_of_rows = pose_message(answer.X_WV_of_rows);
  message.X_WG = pose_message(answer.X_WG);
  message.X_GT = pose_message(answer.X_GT);
  message.reach_m = answer.reach;
  message.part_state = static_cast<std::int32_t>(part_state_of(answer.state));
  message.pushing = answer.pushing;
  message.dropped = answer.dropped;
  message.hold = answer.hold;
  return message;
}

contact_row_t message_of(const ContactRow& row) {
  contact_row_t message;
  put(row.n.data(), message.normal_W);
  put(row.r.data(), message.r_W_m);
  message.bound_m = row.bound;
  message.part = row.part;
  message.other = row.other;
  put(row.r_other.data(), message.r_other_W_m);
  message.range_m = row.range;
  message.approach_m_per_s = row.approach;
  message.pushes = row.pushes ? 1 : 0;
  put(row.friction_ratio_W.data(), message.friction_ratio_W);
  return message;
}

ghost_hand_t message_of(const GhostOfHand& ghost, bool has_fingers) {
  ghost_hand_t message{};
  message.fingers = has_fingers ? 1 : 0;
  message.tracked = ghost.is_tracked ? 1 : 0;
  message.part = ghost.part;
  message.X_WH = pose_message(ghost.X_WH);
  put(ghost.angles.data(), message.joint_angles_rad);
  return message;
}

GhostOfHand ghost_of(const ghost_hand_t& message) {
  GhostOfHand ghost{
      .is_tracked = message.tracked != 0, .X_WH = pose_of(message.X_WH), .angles = {}, .part = message.part};
  std::copy_n(message.joint_angles_rad, ghost.angles.size(), ghost.angles.begin());
  return ghost;
}

hand_answer_t message_of(const HandAnswer& answer) {
  hand_answer_t message{};
  message.activity = static_cast<std::int32_t>(answer.visible.activity);
  message.grasp = static_cast<std::int32_t>(answer.visible.grasp);
  message.X_WH = pose_message(answer.visible.X_WH);
  put(answer.visible.angles.data(), message.joint_angles_rad);
  message.part = answer.part;
  message.decision = answer.decision;
  return message;
}

finger_row_t message_of(std::size_t hand, const FingerRow& row) {
  finger_row_t message{};
  message.hand = static_cast<std::int32_t>(hand);
  put(row.rates.data(), message.rates_m_per_rad);
  message.gap_m = row.gap;
  return message;
}

bool has_fingers(const HandAnswer& answer) {
  return answer.visible.activity != hands::HandActivity::kNone;
}

/// Up to the last one with fingers.
std::size_t hands_with_fingers(const ContactSet& set) {
  std::size_t count = hands::kMaxHands;
  while (count > 0 && !has_fingers(set.hands[count - 1]))
    --count;
  return count;
}

contact_set_t message_of(const AnswerRecord& record) {
  const ContactSet& set = record.set;
  contact_set_t message{};
  message.version = contact_set_t::VERSION;
  message.sequence = set.sequence;
  message.time_ns = record.ghosts.time.count();
  message.part_count = set.part_count;
  for (std::size_t p = 0; p < static_cast<std::size_t>(set.part_count); ++p) {
    message.ghosts.push_back(ghost_message(record.ghosts.parts[p]));
    message.answers.push_back(message_of(set.parts[p]));
  }
  message.row_count = set.row_count;
  for (const ContactRow& row : set.rows())
    message.rows.push_back(message_of(row));
  for (std::size_t h = 0; h < hands_with_fingers(set); ++h) {
    message.ghost_hands.push_back(message_of(record.ghosts.hands[h], has_fingers(set.hands[h])));
    message.hands.push_back(message_of(set.hands[h]));
    for (const FingerRow& row : set.hands[h].rows())
      message.finger_rows.push_back(message_of(h, row));
  }
  message.finger_row_count = static_cast<std::int32_t>(message.finger_rows.size());
  message.hand_count = static_cast<std::int32_t>(message.hands.size());
  return message;
}

}  // namespace

std::vector<std::uint8_t> encode(const AnswerRecord& record) {
  contact_set_t message = message_of(record);
  return to_checked_bytes(message);
}

bool is_message_of(const AnswerRecord& record, std::span<const std::uint8_t> bytes) {
  return is_of(bytes, message_of(record));
}

std::optional<ConsumedByAnswer> decode_answer(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::int32_t, 4> kLargest{contact::kMaxParts, contact::kMaxParts * kMaxContactRows,
                                                 hands::kMaxHands, hands::kMaxHands * kMaxFingerRows};
  const auto message = from_bytes<contact_set_t>(bytes, kLargest);
  if (!message) return std::nullopt;
  ConsumedByAnswer record;
  record.ghosts.time = std::chrono::nanoseconds(message->time_ns);
  for (std::size_t p = 0; p < message->ghosts.size(); ++p)
    record.ghosts.parts[p] = ghost_of(message->ghosts[p]);
  for (std::size_t h = 0; h < message->ghost_hands.size(); ++h) {
    if (message->ghost_hands[h].part < -1 || message->ghost_hands[h].part >= message->part_count) return std::nullopt;
    if (message->ghost_hands[h].fingers != 0) record.ghosts.hands[h] = ghost_of(message->ghost_hands[h]);
  }
  record.sequence = message->sequence;
  record.part_count = message->part_count;
  if (!are_plausible(record.ghosts)) return std::nullopt;
  return record;
}

}  // namespace glissade::haptics

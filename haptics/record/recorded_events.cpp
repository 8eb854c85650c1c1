#include <glissade/haptics/recording.h>

#include "record/message_bytes.h"
#include "record/record_messages.h"

namespace glissade::haptics {

std::vector<devices::LogEvent> RecordedEvents::of(const TickRecord& record) {
  std::vector<devices::LogEvent> events = others_of(record);
  events.insert(events.begin(), devices::to_event(record.time, kHapticTickChannel, encode(record)));
  return events;
}

std::vector<devices::LogEvent> RecordedEvents::others_of(const TickRecord& record) {
  constexpr std::chrono::milliseconds kAnnouncementPeriod(200);  // as LcmGloveHost does
  std::vector<devices::LogEvent> events;
  const auto hand_count = static_cast<std::size_t>(record.hand_count);
  if (record.sequence > 0) events.push_back(devices::to_event(record.time, record.state));
  const bool is_due = !announced_ || record.time - *announced_ >= kAnnouncementPeriod;
  if (is_due) announced_ = record.time;
  for (std::size_t h = 0; h < hand_count && h < head_.gloves.size(); ++h) {
    const devices::GloveInfo& glove = head_.gloves[h];
    if (is_due) events.push_back(devices::to_event(record.time, glove));
    const devices::GloveState& state = record.states[h];
    if (!record.has_state[h] || newest_[h] == state.sequence + 1) continue;
    newest_[h] = state.sequence + 1;
    events.push_back(devices::to_event(record.time, devices::LoggedState{glove.device, glove.session, state}));
  }
  return events;
}

devices::LogEvent RecordedEvents::of(const AnswerRecord& record) {
  return devices::to_event(record.ghosts.time, kContactSetChannel, encode(record));
}

std::array<bool, kMessagesAtOnce> have_right_checksums(
    const std::array<std::span<const std::uint8_t>, kMessagesAtOnce>& messages) {
  std::array<std::span<const std::uint8_t>, kMessagesAtOnce> parts;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (messages[i].size() >= kTypeBytes + kChecksumBytes) parts[i] = checked_part(messages[i]);
  }
  const std::array<std::int64_t, kMessagesAtOnce> checksums = fnv_1a_of_each(parts);
  std::array<bool, kMessagesAtOnce> are_right{};
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (messages[i].size() < kTypeBytes + kChecksumBytes) continue;
    const std::string_view text(reinterpret_cast<const char*>(messages[i].data()), messages[i].size());
    are_right[i] = base::number_at<std::int64_t>(text, text.size() - kChecksumBytes, std::endian::big) == checksums[i];
  }
  return are_right;
}

std::optional<TickRecord> consumed_by_tick(const devices::LogEvent& event) {
  return event.channel == kHapticTickChannel ? decode_tick(event.message) : std::nullopt;
}

}  // namespace glissade::haptics

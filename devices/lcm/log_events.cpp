#include <glissade/devices/event_log.h>

#include "lcm/glove_messages.h"
#include "lcm/haptic_state_message.h"

namespace glissade::devices {

namespace {

/// Whether the event is on this channel, and its message can be decoded into `values`.
template <typename... Values>
bool reads(const LogEvent& event, const char* channel, Values&... values) {
  return event.channel == channel && decode(event.message, values...) == MessageError::kNone;
}

}  // namespace

LogEvent to_event(std::chrono::nanoseconds time, std::string channel, std::vector<std::uint8_t> message) {
  return {std::chrono::duration_cast<std::chrono::microseconds>(time), std::move(channel), std::move(message)};
}

LogEvent to_event(std::chrono::nanoseconds time, const GloveInfo& info) {
  return to_event(time, kGloveInfoChannel, encode(info));
}

LogEvent to_event(std::chrono::nanoseconds time, const LoggedState& state) {
  return to_event(time, kGloveStateChannel, encode({.device = state.device, .session = state.session}, state.state));
}

LogEvent to_event(std::chrono::nanoseconds time, const HapticState& state) {
  return to_event(time, kHapticStateChannel, encode(state));
}

std::optional<GloveInfo> glove_info_of(const LogEvent& event) {
  GloveInfo info;
  return reads(event, kGloveInfoChannel, info) ? std::optional(info) : std::nullopt;
}

std::optional<LoggedState> glove_state_of(const LogEvent& event) {
  StateHeader header;
  LoggedState logged;
  if (!reads(event, kGloveStateChannel, header, logged.state)) return std::nullopt;
  logged.device = header.device;
  logged.session = header.session;
  return logged;
}

std::optional<HapticState> haptic_state_of(const LogEvent& event) {
  HapticState state;
  return reads(event, kHapticStateChannel, state) ? std::optional(state) : std::nullopt;
}

}  // namespace glissade::devices

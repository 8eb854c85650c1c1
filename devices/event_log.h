#pragma once

/// Recorded messages in files of LCM's event log format, which `lcm-logger` writes and `lcm-logplayer` reads too.

#include <chrono>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>

namespace glissade::devices {

/// One message and when it was recorded.
struct LogEvent {
  std::chrono::microseconds time{0};  ///< since an epoch that is the same for all events of a log
  std::string channel;
  std::vector<std::uint8_t> message;

  bool operator==(const LogEvent&) const = default;
};

/// Writes a log. Not thread-safe; may block.
class EventLogWriter {
 public:
  /// Throws std::invalid_argument, naming the file, when it cannot be created.
  explicit EventLogWriter(const std::string& path);

  /// Appends an event. A failure is told by `close`.
  void write(const LogEvent& event);

  /// Ends the log. Throws std::runtime_error, naming the file, when not everything could be written, for example on a
  /// full disk. The destructor reports no failure.
  void close();

 private:
  std::string path_;
  std::ofstream file_;
  std::int64_t written_ = 0;
};

/// Reads a log from the beginning to the end, or up to the first damage: the bytes of a file may be anything. Logs that
/// were joined, and logs from which events were taken out, are whole: the numbers of events are not looked at. Not
/// thread-safe.
class EventLogReader {
 public:
  /// Throws std::invalid_argument, naming the file, when it cannot be read or is no event log.
  explicit EventLogReader(const std::string& path);

  /// The next event; none at the end and from the first damage on.
  std::optional<LogEvent> next();

  /// Number of events read so far.
  std::int64_t count() const noexcept { return count_; }

  /// A sentence with the file, the place and the kind of the damage; empty while there is none.
  const std::string& damage() const noexcept { return damage_; }

 private:
  std::optional<LogEvent> damaged(std::int64_t offset, const std::string& what);
  bool read(std::size_t size, std::string& bytes);

  std::string path_;
  std::vector<char> buffer_;  // of the file, which it outlives
  std::ifstream file_;
  std::int64_t size_ = 0;
  std::int64_t offset_ = 0;  ///< of the next event
  std::int64_t count_ = 0;
  std::string ahead_;  ///< the first bytes of the next event, which show where the last one ends
  std::string damage_;
};

/// The state of a glove, and which glove it is.
struct LoggedState {
  std::int64_t device = 0;
  std::int64_t session = 0;
  GloveState state;
};

/// An event with this message; its time is rounded down to microseconds.
LogEvent to_event(std::chrono::nanoseconds time, std::string channel, std::vector<std::uint8_t> message);

/// Events on the channels of the bus, with the messages that are sent there.
LogEvent to_event(std::chrono::nanoseconds time, const GloveInfo& info);
LogEvent to_event(std::chrono::nanoseconds time, const LoggedState& state);
LogEvent to_event(std::chrono::nanoseconds time, const HapticState& state);

/// What the event tells. No value if it is on another channel, or if the message does not pass the checks of a
/// receiver.
std::optional<GloveInfo> glove_info_of(const LogEvent& event);
std::optional<LoggedState> glove_state_of(const LogEvent& event);
std::optional<HapticState> haptic_state_of(const LogEvent& event);

}  // namespace glissade::devices

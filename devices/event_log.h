#pragma once

/// Recorded messages in LCM's event log format, the format of `lcm-logger` and `lcm-logplayer`.

#include <chrono>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>

namespace glissade::devices {

/// A message and the time of its recording.
struct LogEvent {
  std::chrono::microseconds time{0};  ///< time since an epoch, which is the same for all events of a log
  std::string channel;
  std::vector<std::uint8_t> message;

  bool operator==(const LogEvent&) const = default;
};

/// Writes a log. Not thread-safe; may block.
class GLISSADE_EXPORT EventLogWriter {
 public:
  /// Throws std::invalid_argument, naming the file, when it cannot be created.
  explicit EventLogWriter(const std::string& path);

  /// Appends an event. If this fails, `close` reports the failure.
  void write(const LogEvent& event);

  /// Ends the log. Throws std::runtime_error, naming the file, when something could not be written, for example on a
  /// full disk. The destructor cannot report a failure.
  void close();

 private:
  std::string path_;
  std::ofstream file_;
  std::int64_t written_ = 0;
};

/// Reads a log from the beginning to the end, or up to the first damage. The file may contain arbitrary bytes. Ignores
/// the numbers of events, so concatenated logs and logs with removed events count as undamaged. Not thread-safe.
class GLISSADE_EXPORT EventLogReader {
 public:
  /// Throws std::invalid_argument, naming the file, when it cannot be read or is no event log.
  explicit EventLogReader(const std::string& path);

  /// The next event. Returns no value at the end of the log or after the first damage.
  std::optional<LogEvent> next();

  /// Number of events read so far.
  std::int64_t count() const noexcept { return count_; }

  /// A sentence that names the file, position and kind of the damage; empty if there is no damage.
  const std::string& damage() const noexcept { return damage_; }

 private:
  std::optional<LogEvent> damaged(std::int64_t offset, const std::string& what);
  bool read(std::size_t size, std::string& bytes);

  std::string path_;
  std::vector<char> buffer_;  // of `file_`; the buffer outlives the file
  std::ifstream file_;
  std::int64_t size_ = 0;
  std::int64_t offset_ = 0;  ///< of the next event
  std::int64_t count_ = 0;
  std::string ahead_;  ///< the first bytes of the next event, which mark the end of the last event
  std::string damage_;
};

/// The state of a glove, with the numbers of its device and session.
struct LoggedState {
  std::int64_t device = 0;
  std::int64_t session = 0;
  GloveState state;
};

/// An event with this message. The event's time is rounded down to microseconds.
GLISSADE_EXPORT LogEvent to_event(std::chrono::nanoseconds time, std::string channel,
                                  std::vector<std::uint8_t> message);

/// The event with the channel and message that the value has on the bus.
GLISSADE_EXPORT LogEvent to_event(std::chrono::nanoseconds time, const GloveInfo& info);
GLISSADE_EXPORT LogEvent to_event(std::chrono::nanoseconds time, const LoggedState& state);
GLISSADE_EXPORT LogEvent to_event(std::chrono::nanoseconds time, const HapticState& state);

/// The decoded message of the event. Returns no value if the event is on another channel, or if its message fails the
/// checks of a receiver.
GLISSADE_EXPORT std::optional<GloveInfo> glove_info_of(const LogEvent& event);
GLISSADE_EXPORT std::optional<LoggedState> glove_state_of(const LogEvent& event);
GLISSADE_EXPORT std::optional<HapticState> haptic_state_of(const LogEvent& event);

}  // namespace glissade::devices

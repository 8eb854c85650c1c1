#pragma once

/// An event log as commands read it: an input of the run, with a progress bar.

#include <cstdint>
#include <optional>
#include <string>

#include <glissade/apps/progress.h>
#include <glissade/devices/event_log.h>

namespace glissade::apps {

class LogFile {
 public:
  /// `label` is that of the bar. Throws std::invalid_argument, naming the file, when it cannot be read or is no event
  /// log.
  LogFile(const std::string& path, const std::string& label);

  /// As that of `EventLogReader`.
  std::optional<devices::LogEvent> next();
  /// Notes an event of a known channel that cannot be read.
  void note_unreadable(const devices::LogEvent& event);
  /// A sentence on the damage at which the log ends, else on the events that cannot be read; empty if there are none.
  std::string damage() const;

  const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
  devices::EventLogReader reader_;
  ProgressBar progress_;
  std::int64_t bytes_ = 0;
  std::int64_t events_ = 0;
  std::int64_t unreadable_ = 0;
  std::string first_unreadable_;
};

}  // namespace glissade::apps

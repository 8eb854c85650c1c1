#pragma once

/// What a run in real time writes about itself.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/record/flight_log.h>
#include <glissade/apps/record/recorded_session.h>
#include <glissade/haptics/recording.h>

namespace glissade::apps {

/// Files that a run writes; an empty name: none.
struct RecordSettings {
  std::string log;          ///< all of the run
  bool overwrites = false;  ///< the log may take the place of an older file
  std::string flight;       ///< the last seconds, after a fault or on request
  std::string scene_file;   ///< of the run; empty: the car door of the demonstration
};

/// Throws std::invalid_argument, naming the file, when one of them cannot be written: see `check_recording`.
void validate(const RecordSettings& settings);

class RunRecorders {
 public:
  /// Throws std::invalid_argument, naming the file, when it cannot be created.
  RunRecorders(const RecordSettings& settings, const RecordedSession& session);
  ~RunRecorders();

  /// For the haptic server; null when nothing is written. The server must have stopped before `finish`.
  haptics::LoopObserver* observer() noexcept { return background_.get(); }

  /// Writes the last seconds if a fault or `is_requested` wants it; some times a second. Sentences for the user.
  std::vector<std::string> write_flight(bool is_requested);

  /// Writes what is left. `has_failed`: the run ends by a failure, so the last seconds are wanted too. Sentences for
  /// the user about records that were lost and files that are not whole.
  std::vector<std::string> finish(bool has_failed);

  /// Whether the log holds all of the run; true without a log. After `finish`.
  bool is_whole() const noexcept { return is_whole_; }

 private:
  std::optional<haptics::LogRecorder> log_;
  std::optional<FlightLog> flight_;
  std::unique_ptr<haptics::BackgroundObserver> background_;
  bool is_whole_ = true;
};

}  // namespace glissade::apps

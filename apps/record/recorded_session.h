#pragma once

/// What a recording says of the run as a whole, in its first events.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/record/log_file.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/contact/sliding_rules.h>
#include <glissade/devices/glove_device.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/recording.h>

namespace glissade::apps {

/// The channel of the first event of a run. Its message is a JSON text, whose keys docs/file_formats.md describes.
inline constexpr const char* kHapticSessionChannel = "HAPTIC_SESSION";

/// A glove, and the part that its hand took at the first state.
struct RecordedHand {
  devices::GloveInfo glove;
  std::optional<std::size_t> part;               ///< number of the part in the scene
  std::optional<grasping::HandShape> fingers{};  ///< of a hand that takes hold with its fingers
};

/// All that a replay needs to know before the first tick.
struct RecordedSession {
  std::string scene_file;        ///< absolute path; empty: that of the demonstration
  std::uint64_t scene_hash = 0;  ///< as `simulation::hash_of` gives it
  contact::SlidingRules rules;   ///< of the simulation, without those of `choice`
  SlidingChoice choice;
  std::chrono::nanoseconds period{haptics::kTickPeriod};  ///< of the haptic loop
  std::vector<RecordedHand> hands;
};

/// The path as a recording names it.
std::string recorded_path(const std::string& scene_file);

/// The head of a recording: the session, then the announcement of each glove.
haptics::RecordingHead head_of(const RecordedSession& session);

/// The session of a run, of which joined logs have several: that of `event`, and the announcements of its gloves, which
/// follow it in the log. Throws std::invalid_argument, naming the file, for a session that cannot be read, and
/// std::runtime_error where the log is damaged.
RecordedSession read_session(const devices::LogEvent& event, LogFile& log);

/// Reads up to the first run of a log. Throws as `read_session`, and std::invalid_argument when there is no run.
RecordedSession first_session(LogFile& log);

}  // namespace glissade::apps

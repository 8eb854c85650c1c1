#pragma once

/// What a recording says of the run as a whole, in its first events.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/scene/sliding_option.h>
#include <glissade/devices/event_log.h>
#include <glissade/devices/glove_device.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/recording.h>
#include <glissade/haptics/sliding_rules.h>

namespace glissade::apps {

/// The channel of the first event. Its message is a JSON text, whose keys docs/file_formats.md describes.
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
  std::uint64_t scene_hash = 0;  ///< as `scene_hash` gives it
  haptics::SlidingRules rules;   ///< of the simulation, without those of `choice`
  SlidingChoice choice;
  std::chrono::nanoseconds period{haptics::kTickPeriod};  ///< of the haptic loop
  std::vector<RecordedHand> hands;
};

/// The path as a recording names it.
std::string recorded_path(const std::string& scene_file);

/// The head of a recording: the session, then the announcement of each glove.
haptics::RecordingHead head_of(const RecordedSession& session);

/// The session of a log, from its first events. Throws std::invalid_argument, naming the file, when the log does not
/// begin with a session.
RecordedSession read_session(devices::EventLogReader& log, const std::string& path);

}  // namespace glissade::apps

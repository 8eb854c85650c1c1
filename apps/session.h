#pragma once

/// What a run of the haptic loop left behind, and what is to be said of it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <glissade/apps/haptic_scene.h>
#include <glissade/collision/frame_result.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/realtime/periodic_loop.h>

namespace glissade::apps {

/// Keeps the newest samples of a run in memory allocated beforehand, for the haptic thread to fill.
class SessionRecorder {
 public:
  explicit SessionRecorder(std::size_t capacity) : samples_(capacity) {}

  /// Wait-free, no allocation. One thread.
  void record(const devices::HapticState& sample) noexcept {
    samples_[static_cast<std::size_t>(total_) % samples_.size()] = sample;
    ++total_;
  }

  /// Ticks recorded, those that were overwritten included. After the run.
  std::int64_t total() const { return total_; }
  /// The kept samples, oldest first. After the run.
  std::vector<devices::HapticState> samples() const;

 private:
  std::vector<devices::HapticState> samples_;
  std::int64_t total_ = 0;
};

/// What only a run in real time has.
struct RealTimeFigures {
  haptics::HapticServerStatistics server;
  realtime::PeriodicStatistics bare_timer;  ///< of an empty loop beside it
};

/// A finished run.
struct Session {
  std::int64_t ticks = 0;
  std::int64_t objects = 0;           ///< of the scene, the part among them
  std::int64_t collision_frames = 0;  ///< how often the simulation looked around
  collision::FrameReport collision;   ///< the sum of the accounts of these
  std::vector<devices::HapticState> samples;
  std::optional<RealTimeFigures> real_time;  ///< none for an offline run
};

/// The figures of a session. A part counts as seated within 2 mm and 2° of the goal at the end.
struct SessionSummary {
  std::int64_t ticks = 0;
  std::int64_t samples = 0;
  std::int64_t colliding_poses = 0;
  double contact_fraction = 0.0;
  std::int32_t contacts_max = 0;
  std::array<std::int64_t, devices::kPartStates> state_ticks{};  ///< samples in each state of the part, by its number
  std::int64_t state_changes = 0;                                ///< from one sample to the next
  double force_max_N = 0.0;
  std::optional<bool> seat_reached;  ///< none when the scene has no goal
  double seat_distance_m = 0.0;
  std::uint64_t hash = 0;  ///< of all visible poses and wrenches
};

/// Computes the summary; the visible poses are checked by brute force that shares nothing with the DOP-tree, with a
/// progress bar.
SessionSummary summarize(const Session& session, const HapticScene& scene);

/// The summary as one JSON object; figures that an offline run does not have are null.
nlohmann::json to_json(const SessionSummary& summary, const Session& session);
/// The summary for a person, some lines.
std::string to_text(const SessionSummary& summary, const Session& session);
/// An HTML page with the summary and the plots of force, lag and states in `folder`; returns its path.
std::string write_session_report(const SessionSummary& summary, const Session& session, const std::string& title,
                                 const std::string& folder);

/// Prints the summary as text or JSON, and writes the report where a folder is given. Throws std::runtime_error when a
/// visible pose collides.
void conclude(const Session& session, const HapticScene& scene, const std::string& title, bool as_json,
              const std::string& report_folder);

}  // namespace glissade::apps

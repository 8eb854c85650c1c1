#pragma once

/// The record of a run of the haptic loop, its summary, and its output.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <glissade/apps/run/session_recorder.h>
#include <glissade/apps/run/stop_errors.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/collision/frame_result.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/realtime/periodic_loop.h>

namespace glissade::apps {

/// Figures that only a run in real time has.
struct RealTimeFigures {
  haptics::HapticServerStatistics server;
  realtime::PeriodicStatistics bare_timer;  ///< of an empty loop that runs beside it
};

/// The messages of a glove over a whole run.
struct LinkSummary {
  std::uint64_t states = 0;          ///< that arrived
  std::uint64_t states_lost = 0;     ///< by their sequence
  std::uint64_t states_refused = 0;  ///< except those of other gloves
  std::uint64_t commands = 0;        ///< that were sent
  std::uint64_t commands_dropped = 0;
};

/// A finished run.
struct Session {
  std::int64_t ticks = 0;
  std::chrono::nanoseconds period{};  ///< of the ticks
  std::int64_t objects = 0;           ///< of the scene, including the parts
  std::int64_t collision_frames = 0;  ///< searches for contacts, one frame each
  collision::FrameReport collision;   ///< sum of the reports of these frames
  contact::CallStatistics calls;      ///< of the simulation
  std::vector<std::int64_t> devices;  ///< the number of each hand's glove
  /// Of each hand; null if it has no fingers in the simulation.
  std::vector<std::shared_ptr<const grasping::HandModel>> hand_models;
  std::shared_ptr<const SessionRecorder> samples;
  std::optional<RealTimeFigures> real_time;  ///< none for an offline run
  StopErrors::Figures stops{};               ///< of an offline run
  std::vector<LinkSummary> links{};          ///< of each glove; none in an offline run
  std::string recording;                     ///< file; empty if none was wanted
  bool is_recording_whole = true;            ///< false if parts of it are missing
  SlidingChoice choice{};                    ///< of the user
};

/// The figures of a part over the kept ticks.
struct PartSummary {
  std::string name;
  std::int64_t colliding_poses = 0;  ///< of the ticks: with an obstacle, or with a part before it
  double contact_fraction = 0.0;
  std::int32_t contacts_max = 0;
  std::array<std::int64_t, devices::kPartStates> state_ticks{};  ///< ticks in each state of the part, by its number
  std::int64_t state_changes = 0;                                ///< from one tick to the next
};

/// The name of the state of a part with this number.
std::string name_of_state(std::size_t number);

/// The figures of a hand over the kept ticks.
struct HandSummary {
  std::int64_t device = 0;  ///< number of its glove
  std::int64_t grasps = 0;  ///< how often it took hold
  std::int64_t holding_ticks = 0;
  bool has_fingers = false;
  std::string missed_grasp;             ///< of a hand with fingers that never took hold: why, as `MissedGrasp`
  std::int64_t colliding_postures = 0;  ///< of the ticks: of its segments with an obstacle or a part
  double joint_torque_max_Nm = 0.0;
  double force_max_N = 0.0;
  double force_step_max_N = 0.0;    ///< greatest change of the force from one tick to the next
  std::int64_t lagging_ticks = 0;   ///< ticks whose contacts exerted less than half of their force
  std::int64_t unsolved_ticks = 0;  ///< ticks whose contacts had no solution
  std::array<std::int64_t, devices::kLimitReasons.size()> limited_ticks{};  ///< ticks with each of `kLimitReasons`
};

/// The figures of a session. The first part reaches the goal if it ends within 2 mm and 2° of it.
struct SessionSummary {
  std::int64_t ticks = 0;
  std::int64_t samples = 0;  ///< kept ticks
  std::int64_t checked = 0;  ///< of these, the ticks whose poses were checked for collisions
  std::vector<PartSummary> parts;
  std::vector<HandSummary> hands;
  std::optional<bool> goal_reached;  ///< none when the scene has no goal
  double goal_distance_m = 0.0;
  std::uint64_t hash = 0;  ///< of all visible poses and wrenches

  std::int64_t colliding_poses() const;
};

/// Computes the summary. Checks the visible poses of all parts and hands by brute force, until
/// `should_end` (`SessionCheck`).
SessionSummary summarize(const Session& session, const HapticScene& scene,
                         const std::function<bool()>& should_end = {});

/// The summary as one JSON object; figures that an offline run does not have are null.
nlohmann::json to_json(const SessionSummary& summary, const Session& session);
/// The summary as lines of text; with the stages of the search for contacts and the hash, if it is `verbose`.
std::string to_text(const SessionSummary& summary, const Session& session, bool verbose);
/// An HTML page with the rules, the summary, the run in three dimensions, and plots of wrenches, lag, contacts, their
/// age and states in `folder`; returns its path.
std::string write_session_report(const SessionSummary& summary, const Session& session, const std::string& title,
                                 const std::string& folder, const HapticScene& scene);

/// Help on the option --verbose.
inline constexpr const char* kVerboseHelp =
    "Add the stages of the search for contacts and the hash of the run to the summary";

/// If most calls of the simulation ended early in a run in real time, or its answers were old: a sentence that it did
/// not keep up. Else empty.
std::string real_time_warning(const Session& session);

/// Prints the summary as text or JSON, warns if the simulation did not keep up with real time, and writes the report
/// unless `report_folder` is empty. Returns the summary. After Ctrl-C, checks the poses of half a second only. Throws
/// std::runtime_error when a visible pose collides, or when the recording is not whole.
SessionSummary conclude(const Session& session, const HapticScene& scene, const std::string& title, bool as_json,
                        bool verbose, const std::string& report_folder);

}  // namespace glissade::apps

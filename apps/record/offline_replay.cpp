#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/record/log_file.h>
#include <glissade/apps/record/offline_replay.h>
#include <glissade/apps/record/recorded_scene.h>
#include <glissade/apps/record/recorded_session.h>
#include <glissade/apps/scene/session_start.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/realtime/clock.h>

namespace glissade::apps {

namespace {

/// The hands that take hold in a run.
std::vector<Grip> grips_of(const RecordedSession& session, const HapticScene& scene, const std::string& log_path) {
  std::vector<Grip> grips;
  for (const RecordedHand& hand : session.hands) {
    if (hand.part && *hand.part >= scene.parts.size()) {
      throw std::invalid_argument(log_path + ": glove " + std::to_string(hand.glove.device) + " holds part " +
                                  std::to_string(*hand.part) + ", which the scene does not have");
    }
    grips.push_back({hand.glove.descriptor, hand.part, hand.fingers});
  }
  return grips;
}

void begin(ReplayAudience& audience, const HapticScene& scene, const RecordedSession& session,
           const grasping::GraspSimulation& simulation) {
  std::vector<std::int64_t> devices;
  for (const RecordedHand& hand : session.hands)
    devices.push_back(hand.glove.device);
  audience.begin(scene, session.choice, session.period, devices, hand_models(simulation, devices.size()));
}

/// Feeds a run to its replay. Returns the session of the next run in the log.
std::optional<RecordedSession> feed(LogFile& log, haptics::Replay& replay, ReplayAudience* audience) {
  while (std::optional<devices::LogEvent> event = log.next()) {
    if (event->channel == kHapticSessionChannel) {
      if (!replay.finish()) return std::nullopt;
      return read_session(*event, log);
    }
    const auto state = audience != nullptr ? devices::haptic_state_of(*event) : std::nullopt;
    if (!replay.take(std::move(*event))) return std::nullopt;
    if (!state || audience->take(*state)) continue;
    replay.settle();
    return std::nullopt;
  }
  log.damage().empty() ? replay.finish() : replay.settle();
  return std::nullopt;
}

/// Repeats a run, adds what came of it, and returns the session of the next one.
std::optional<RecordedSession> repeat(const RecordedSession& session, LogFile& log, const std::string& scene_file,
                                      ReplayAudience* audience, ReplayOutcome& outcome) {
  const HapticScene scene = recorded_scene(log.path(), session, scene_file);
  const std::vector<Grip> grips = grips_of(session, scene, log.path());
  contact::SlidingRules rules = session.rules;
  rules.has_search_thread = true;  // takes less time, and gives the same bits
  grasping::GraspSimulation simulation = start_simulation(scene, grips, session.choice, rules, session.period);
  std::vector<haptics::KernelHand> hands;
  for (const Grip& grip : grips)
    hands.push_back({.device = grip.device, .part = grip.part});
  if (audience != nullptr) begin(*audience, scene, session, simulation);
  haptics::Replay replay(simulation, hands, session.period, head_of(session));

  realtime::SteadyClock clock;
  const std::chrono::nanoseconds start = clock.now();
  std::optional<RecordedSession> next = feed(log, replay, audience);
  ++outcome.runs;
  outcome.ticks += replay.ticks();
  outcome.contact_sets += replay.answers();
  outcome.recorded += replay.duration();
  outcome.elapsed += clock.now() - start;
  if (!replay.difference().empty()) {
    const std::string run = outcome.runs > 1 ? "run " + std::to_string(outcome.runs) + ": " : "";
    outcome.difference = run + replay.difference();
  }
  return next;
}

}  // namespace

ReplayOutcome replay_offline(const std::string& log_path, const std::string& scene_file, ReplayAudience* audience) {
  LogFile log(log_path, "replay");
  ReplayOutcome outcome;
  for (std::optional<RecordedSession> session = first_session(log); session;)
    session = repeat(*session, log, scene_file, audience, outcome);
  // The log is read ahead: damage after the first difference is of no interest.
  if (outcome.difference.empty()) outcome.damage = log.damage();
  return outcome;
}

}  // namespace glissade::apps

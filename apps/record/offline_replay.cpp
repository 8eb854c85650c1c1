#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glissade/apps/progress.h>
#include <glissade/apps/record/offline_replay.h>
#include <glissade/apps/record/recorded_scene.h>
#include <glissade/apps/record/recorded_session.h>
#include <glissade/apps/scene/session_start.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/realtime/clock.h>

namespace glissade::apps {

ReplayOutcome replay_offline(const std::string& log_path, const std::string& scene_file, ReplayAudience* audience) {
  devices::EventLogReader log(log_path);
  const RecordedSession session = read_session(log, log_path);
  const HapticScene scene = recorded_scene(log_path, session, scene_file);
  std::vector<Grip> grips;
  for (const RecordedHand& hand : session.hands) {
    if (hand.part && *hand.part >= scene.parts.size()) {
      throw std::invalid_argument(log_path + ": glove " + std::to_string(hand.glove.device) + " holds part " +
                                  std::to_string(*hand.part) + ", which the scene does not have");
    }
    grips.push_back({hand.glove.descriptor, hand.part, hand.fingers});
  }
  haptics::SlidingRules rules = session.rules;
  rules.has_search_thread = true;  // takes less time, and gives the same bits
  StartedSimulation started = start_simulation(scene, grips, session.choice, rules, session.period);
  std::vector<haptics::KernelHand> hands;
  for (std::size_t h = 0; h < grips.size(); ++h)
    hands.push_back({grips[h].device, grips[h].part, started.fingers[h]});
  if (audience != nullptr) {
    std::vector<std::int64_t> devices;
    for (const RecordedHand& hand : session.hands)
      devices.push_back(hand.glove.device);
    audience->begin(scene, session.choice, session.period, devices, started.models);
  }
  haptics::Replay replay(*started.simulation, hands, session.period, head_of(session));

  ProgressBar progress("replay", static_cast<std::int64_t>(std::filesystem::file_size(log_path)));
  realtime::SteadyClock clock;
  const std::chrono::nanoseconds start = clock.now();
  std::int64_t bytes = 0;
  bool is_watched = true;
  while (std::optional<devices::LogEvent> event = log.next()) {
    bytes += std::ssize(event->message);
    progress.update(bytes);
    const auto state = audience != nullptr ? devices::haptic_state_of(*event) : std::nullopt;
    if (!replay.take(std::move(*event))) break;
    is_watched = !state || audience->take(*state);
    if (!is_watched) break;
  }
  log.damage().empty() && is_watched ? replay.finish() : replay.settle();
  return {.ticks = replay.ticks(),
          .contact_sets = replay.answers(),
          .recorded = replay.duration(),
          .elapsed = clock.now() - start,
          .difference = replay.difference(),
          // The log is read ahead: damage after the first difference is of no interest.
          .damage = replay.difference().empty() ? log.damage() : ""};
}

}  // namespace glissade::apps

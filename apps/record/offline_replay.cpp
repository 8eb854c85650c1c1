#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glissade/apps/embedded_scene.h>
#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/record/offline_replay.h>
#include <glissade/apps/record/recorded_session.h>
#include <glissade/apps/record/scene_hash.h>
#include <glissade/apps/session_start.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/realtime/clock.h>

namespace glissade::apps {

namespace {

HapticScene recorded_scene(const std::string& log_path, const RecordedSession& session, const std::string& scene_file) {
  const std::string& file = scene_file.empty() ? session.scene_file : scene_file;
  const bool has_fingers =
      std::any_of(session.hands.begin(), session.hands.end(), [](const RecordedHand& hand) { return hand.fingers; });
  const Scene scene = read_or_embedded_scene(file, has_fingers ? Demonstration::kDoorModule : Demonstration::kCarDoor);
  HapticScene result = make_haptic_scene(scene, movable_objects(scene));
  if (scene_hash(result) == session.scene_hash) return result;
  throw std::invalid_argument(result.source + ": is not the scene of " + log_path +
                              ", or has changed since; --scene names another file");
}

}  // namespace

ReplayOutcome replay_offline(const std::string& log_path, const std::string& scene_file) {
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
  haptics::Replay replay(*started.simulation, hands, session.period, head_of(session));

  ProgressBar progress("replay", static_cast<std::int64_t>(std::filesystem::file_size(log_path)));
  realtime::SteadyClock clock;
  const std::chrono::nanoseconds start = clock.now();
  std::int64_t bytes = 0;
  while (std::optional<devices::LogEvent> event = log.next()) {
    bytes += std::ssize(event->message);
    progress.update(bytes);
    if (!replay.take(std::move(*event))) break;
  }
  log.damage().empty() ? replay.finish() : replay.settle();
  return {.ticks = replay.ticks(),
          .contact_sets = replay.answers(),
          .recorded = replay.duration(),
          .elapsed = clock.now() - start,
          .difference = replay.difference(),
          // The log is read ahead: damage after the first difference is of no interest.
          .damage = replay.difference().empty() ? log.damage() : ""};
}

}  // namespace glissade::apps

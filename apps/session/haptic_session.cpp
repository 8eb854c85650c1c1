#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <thread>

#include <glissade/apps/progress.h>
#include <glissade/apps/record/dump_signal.h>
#include <glissade/apps/run/link_watch.h>
#include <glissade/apps/run/machine_check.h>
#include <glissade/apps/run/run_watch.h>
#include <glissade/apps/run/session_sink.h>
#include <glissade/apps/run/stop_errors.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/session_start.h>
#include <glissade/apps/session/haptic_session.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/session_view.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/realtime/clock.h>

namespace glissade::apps {

namespace {

/// What is kept of a run without an end.
constexpr std::chrono::minutes kKept{1};

/// The session of an offline run.
RecordedSession offline_session(const HapticScene& scene, const Grip& grip, const SlidingChoice& choice,
                                const RecordSettings& record) {
  // There is no link, so the number of its session is made up.
  const devices::GloveInfo glove{.device = devices::kDefaultDevice, .session = 1, .descriptor = grip.device};
  return {.scene_file = recorded_path(record.scene_file),
          .scene_hash = simulation::hash_of(scene),
          .choice = choice,
          .hands = {{glove, grip.part, grip.fingers}}};
}

/// The session of a run in real time, for which all gloves have been heard.
RecordedSession real_time_session(const HapticScene& scene, const std::vector<devices::GloveInfo>& gloves,
                                  const std::vector<Grip>& grips, const RunSettings& settings,
                                  std::chrono::nanoseconds period) {
  RecordedSession session{.scene_file = recorded_path(settings.record.scene_file),
                          .scene_hash = simulation::hash_of(scene),
                          .rules = contact::real_time_rules(),
                          .choice = settings.choice,
                          .period = period};
  for (std::size_t h = 0; h < gloves.size(); ++h)
    session.hands.push_back({gloves[h], grips[h].part, grips[h].fingers});
  return session;
}

Session finished(std::int64_t ticks, std::chrono::nanoseconds period, const HapticScene& scene,
                 const grasping::GraspSimulation& simulation, const std::vector<std::int64_t>& devices,
                 std::shared_ptr<const SessionRecorder> samples, std::optional<RealTimeFigures> real_time) {
  const contact::MultiPartSliding& sliding = simulation.parts();
  const contact::SearchStatistics& work = sliding.search_statistics();
  return {ticks,
          period,
          std::ssize(scene.body_names),
          work.searches,
          work.reports,
          sliding.call_statistics(),
          devices,
          hand_models(simulation, devices.size()),
          std::move(samples),
          std::move(real_time)};
}

/// The period of a device, within the bounds of the haptic loop.
std::chrono::nanoseconds period_of(const devices::DeviceDescriptor& device) {
  const std::chrono::nanoseconds period(std::llround(1e9 / device.update_rate));
  return std::clamp<std::chrono::nanoseconds>(period, haptics::kShortestTickPeriod, haptics::kLongestTickPeriod);
}

void check_spin(std::chrono::nanoseconds spin, std::chrono::nanoseconds period) {
  if (spin <= period / 2) return;
  const auto text_us = [](std::chrono::nanoseconds time) {
    return format_number(1e-3 * static_cast<double>(time.count()));
  };
  throw std::invalid_argument("--spin-us: must be at most half of the haptic loop's period, " + text_us(period / 2) +
                              ", not " + text_us(spin));
}

/// That this glove is silent while others send, which the run does not use; empty if there are none.
std::string told_silence(std::int64_t device, const std::vector<SessionHand>& hands,
                         const devices::GloveSearch& search) {
  std::string others;
  for (const std::int64_t heard : search.heard()) {
    if (std::any_of(hands.begin(), hands.end(), [heard](const SessionHand& hand) { return hand.device == heard; }))
      continue;
    others += (others.empty() ? "" : ", ") + std::to_string(heard);
  }
  if (others.empty()) return "";
  return "glove " + std::to_string(device) + " is silent, but there are other gloves (--device): " + others;
}

/// The announcements of all gloves of a run; fewer if it is stopped before.
std::vector<devices::GloveInfo> wait_for_gloves(const std::shared_ptr<devices::LcmBus>& bus,
                                                const std::vector<SessionHand>& hands,
                                                const std::function<bool()>& should_stop,
                                                const std::function<void(const RunNews&)>& watch) {
  devices::GloveSearch search(bus);  // one for all: an announcement is heard whenever it comes
  std::vector<devices::GloveInfo> infos;
  constexpr int kPatientTurns = 10;  // a second
  int turns = 0;
  std::set<std::string> told;
  while (infos.size() < hands.size() && !should_stop()) {
    const std::int64_t device = hands[infos.size()].device;
    watch({.awaited_device = device});
    if (auto info = search.wait_for(device, std::chrono::milliseconds(100))) {
      infos.push_back(std::move(*info));
      turns = 0;
    } else if (++turns >= kPatientTurns) {
      std::vector<std::string> sentences = search.troubles();
      if (std::string silence = told_silence(device, hands, search); !silence.empty())
        sentences.push_back(std::move(silence));
      std::erase_if(sentences, [&](const std::string& sentence) { return !told.insert(sentence).second; });
      if (!sentences.empty()) watch({.sentences = std::move(sentences)});
    }
  }
  return infos;
}

RunWatch watch_of(const HapticScene& scene, const RunSettings& settings) {
  std::vector<std::string> part_names;
  for (const ScenePart& part : scene.parts)
    part_names.push_back(part.name);
  std::vector<RunWatch::Hand> hands;
  for (const SessionHand& hand : settings.hands)
    hands.push_back({hand.device, hand.part});
  return {std::move(part_names), hands, settings.seconds};
}

/// Shows the run to browsers, and waits for the first one if that is wanted.
std::unique_ptr<viewer::ViewServer> view_of(const HapticScene& scene, const RunSettings& settings,
                                            const grasping::GraspSimulation& simulation,
                                            const std::function<bool()>& should_stop,
                                            const std::function<void(const RunNews&)>& watch) {
  if (!settings.view_port) return nullptr;
  std::vector<std::int64_t> devices;
  for (const SessionHand& hand : settings.hands)
    devices.push_back(hand.device);
  auto server = open_view(view_scene_of(scene, glove_names(devices), hand_models(simulation, devices.size())),
                          *settings.view_port);
  watch({.sentences = {"open " + server->url() + (settings.waits_for_page ? " in a browser: then it starts" : "")}});
  while (settings.waits_for_page && !server->has_had_client() && !should_stop())
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return server;
}

/// What each hand takes, with what is known of its glove. Without a glove, the session ends at once.
std::vector<Grip> grips_of(const std::vector<SessionHand>& wanted, const std::vector<devices::GloveInfo>& infos) {
  std::vector<Grip> grips;
  for (std::size_t h = 0; h < wanted.size(); ++h) {
    Grip& grip = grips.emplace_back();
    grip = {h < infos.size() ? infos[h].descriptor : devices::simulated_glove_descriptor(), wanted[h].part,
            wanted[h].fingers};
    if (grip.fingers && h < infos.size() && infos[h].side != hands::HandSide::kUnknown)
      grip.fingers->side = infos[h].side;
  }
  return grips;
}

std::chrono::nanoseconds period_of_fastest(const std::vector<Grip>& grips) {
  std::chrono::nanoseconds fastest = haptics::kLongestTickPeriod;
  for (const Grip& grip : grips)
    fastest = std::min(fastest, period_of(grip.device));
  return fastest;
}

/// Of a run of this length; 0 of one without an end.
std::int64_t ticks_of(const RunSettings& settings, std::chrono::nanoseconds period) {
  return std::llround((settings.seconds + settings.longer_s) / std::chrono::duration<double>(period).count());
}

std::vector<LinkSummary> links_of(const std::vector<std::unique_ptr<devices::LcmGlove>>& gloves) {
  std::vector<LinkSummary> links;
  for (const std::unique_ptr<devices::LcmGlove>& glove : gloves) {
    const devices::LinkStatistics states = glove->statistics();
    links.push_back({states.accepted, states.lost, states.rejected() - states.other_receiver, glove->commands_sent(),
                     glove->commands_dropped()});
  }
  return links;
}

/// Tells what happens while the server runs.
void watch_until_end(haptics::HapticServer& server, const std::vector<std::unique_ptr<devices::LcmGlove>>& gloves,
                     const std::vector<std::int64_t>& numbers, RunWatch& run_watch, RunRecorders& recorders,
                     const std::function<bool()>& should_stop, const std::function<void(const RunNews&)>& watch) {
  const std::string missing = missing_rights(server.scheduling().is_fifo, server.scheduling().has_locked_memory);
  if (!missing.empty()) watch({.sentences = {missing}});
  std::set<std::string> told;
  std::vector<LinkWatch> links;
  for (const std::int64_t number : numbers)
    links.emplace_back(number);
  while (!server.is_done() && !server.has_failed() && !should_stop()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    RunWatch::News news = run_watch.news(server.late_ticks());
    for (std::size_t h = 0; h < gloves.size(); ++h) {
      for (std::string& sentence : links[h].news(gloves[h]->statistics()))
        if (told.insert(sentence).second) news.events.push_back(std::move(sentence));  // it may concern all gloves
    }
    for (std::string& sentence : recorders.write_flight(DumpSignal::take()))
      news.events.push_back(std::move(sentence));
    watch({.ticks = server.ticks(), .sentences = std::move(news.events), .status = std::move(news.status)});
  }
}

}  // namespace

Session run_session_offline(const HapticScene& scene, devices::SimulatedGlove glove, bool has_fingers,
                            std::int64_t ticks, const SlidingChoice& choice, const RecordSettings& record) {
  Grip grip{.device = glove.descriptor()};
  if (has_fingers) {
    grip.fingers.emplace();
  } else {
    grip.part = 0;
  }
  grasping::GraspSimulation simulation = start_simulation(scene, {grip}, choice, {});
  validate(record);
  for (const std::string& sentence : limits_of_devices({grip}, choice, haptics::kTickPeriod))
    say("glissade: " + sentence);
  const contact::MultiPartSliding& sliding = simulation.parts();
  const auto recorder = std::make_shared<SessionRecorder>(static_cast<std::size_t>(ticks), sliding.part_count(), 1);
  std::optional<haptics::LogRecorder> log;
  if (!record.log.empty()) log.emplace(record.log, head_of(offline_session(scene, grip, choice, record)));
  ProgressBar progress("offline", ticks);
  StopErrors stops;
  haptics::run_offline({{&glove, grip.part}}, simulation, ticks,
                       [&](const devices::HapticState& sample) {
                         recorder->record(sample);
                         stops.note(sample, glove);
                         progress.update(recorder->total());
                       },
                       {.observer = log ? &*log : nullptr});
  if (log) log->close();
  Session session =
      finished(ticks, haptics::kTickPeriod, scene, simulation, {devices::kDefaultDevice}, recorder, std::nullopt);
  session.stops = stops.figures();
  session.recording = record.log;
  session.choice = choice;
  return session;
}

Session run_session(const HapticScene& scene, const std::shared_ptr<devices::LcmBus>& bus, const RunSettings& settings,
                    const std::function<bool()>& should_stop, const std::function<void(const RunNews&)>& watch) {
  start_simulation(scene, {}, settings.choice, {});  // errors come before waiting
  validate(settings.record);
  if (settings.period) check_spin(settings.spin, *settings.period);
  if (settings.view_port) open_view({}, *settings.view_port);  // throws if the port is taken
  const std::vector<devices::GloveInfo> infos = wait_for_gloves(bus, settings.hands, should_stop, watch);
  const std::vector<Grip> grips = grips_of(settings.hands, infos);
  const std::chrono::nanoseconds fastest = period_of_fastest(grips);
  const std::chrono::nanoseconds period = settings.period.value_or(fastest);
  check_spin(settings.spin, period);
  if (period > fastest)
    watch({.sentences = {"a glove is faster than the haptic loop: its force may fade (--rate-hz)"}});
  const std::int64_t ticks = ticks_of(settings, period);
  grasping::GraspSimulation simulation =
      start_simulation(scene, grips, settings.choice, contact::real_time_rules(), period);
  watch({.sentences = limits_of_devices(grips, settings.choice, period, true)});
  const auto recorder = std::make_shared<SessionRecorder>(static_cast<std::size_t>(ticks > 0 ? ticks : kKept / period),
                                                          simulation.part_count(), settings.hands.size());
  RunWatch run_watch = watch_of(scene, settings);
  const std::unique_ptr<viewer::ViewServer> view = view_of(scene, settings, simulation, should_stop, watch);
  SessionSink sink(bus, recorder, run_watch, view.get());
  std::vector<std::unique_ptr<devices::LcmGlove>> gloves;
  std::vector<haptics::HandInLoop<devices::GloveDevice>> hands;
  std::vector<std::int64_t> numbers;
  for (std::size_t h = 0; h < settings.hands.size(); ++h) {
    const std::int64_t device = settings.hands[h].device;
    gloves.push_back(std::make_unique<devices::LcmGlove>(
        bus, grips[h].device,
        devices::LcmGloveOptions{.device = device, .glove_session = h < infos.size() ? infos[h].session : 0}));
    hands.push_back({gloves.back().get(), grips[h].part});
    numbers.push_back(device);
  }
  // A run that ends before all gloves have been heard leaves an older file alone.
  const bool has_all = infos.size() == settings.hands.size();
  RunRecorders recorders(has_all ? settings.record : RecordSettings{},
                         real_time_session(scene, infos, grips, settings, period));
  haptics::HapticServer server(hands, simulation,
                               {.period = period,
                                .ticks = ticks,
                                .spin = settings.spin,
                                .sink = [&sink](const devices::HapticState& sample) { sink.receive(sample); },
                                .observer = recorders.observer()});
  realtime::SteadyClock clock;
  realtime::PeriodicThread bare_timer(clock, {.period = period, .fifo_priority = realtime::kHapticPriority},
                                      [](const realtime::PeriodicTick&) { return true; });
  watch_until_end(server, gloves, numbers, run_watch, recorders, should_stop, watch);
  server.stop();
  watch({.ticks = server.ticks(), .sentences = run_watch.news(server.late_ticks()).events});
  watch({.ticks = server.ticks(), .sentences = recorders.finish(server.has_failed())});
  bare_timer.stop();
  if (server.has_failed()) throw std::runtime_error("the simulation failed: " + server.failure());
  Session session = finished(server.ticks(), period, scene, simulation, numbers, recorder,
                             RealTimeFigures{server.statistics(), bare_timer.statistics()});
  session.links = links_of(gloves);
  if (has_all) session.recording = settings.record.log;
  session.is_recording_whole = recorders.is_whole();
  session.choice = settings.choice;
  return session;
}

}  // namespace glissade::apps

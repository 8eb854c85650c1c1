#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include <glissade/apps/haptic_session.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/reason_teller.h>
#include <glissade/apps/text.h>
#include <glissade/devices/haptic_state_publisher.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/haptics/offline_run.h>
#include <glissade/realtime/clock.h>

namespace glissade::apps {

namespace {

constexpr int kFifoPriority = 80;
/// Ticks kept of a run without an end: the last minute.
constexpr std::size_t kKeptTicks = 60'000;

/// Options with the default stiffness of the part, lowered to the limits of the device.
haptics::SlidingOptions sliding_options(const HapticScene& scene, const devices::DeviceDescriptor& device,
                                        const haptics::SlidingRules& rules,
                                        std::chrono::nanoseconds period = haptics::kTickPeriod) {
  const haptics::Coupling coupling =
      haptics::coupling_for(device, haptics::default_stiffness(scene.part_V->radius()), period);
  return {.metaphor = haptics::Metaphor::kForceFeedback, .stiffness = coupling.stiffness, .rules = rules};
}

/// Starts the simulation. The error for a part that starts inside an obstacle names the scene.
haptics::Sliding start_sliding(const HapticScene& scene, const haptics::SlidingOptions& options) {
  try {
    return haptics::Sliding(scene.obstacles, scene.part_V, scene.X_WV_start, options);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(scene.source + ": object " + in_quotes(scene.part_name) + ": " + error.what());
  }
}

Session finished(std::int64_t ticks, std::chrono::nanoseconds period, const HapticScene& scene,
                 const haptics::Sliding& sliding, const SessionRecorder& recorder,
                 std::optional<RealTimeFigures> real_time) {
  const haptics::SearchStatistics work = sliding.search_statistics();
  return {ticks,
          period,
          std::ssize(scene.obstacles) + 1,
          work.searches,
          work.reports,
          recorder.samples(),
          std::move(real_time)};
}

/// The period of a device, within the bounds of the haptic loop.
std::chrono::nanoseconds period_of(const devices::DeviceDescriptor& device) {
  const std::chrono::nanoseconds period(std::llround(1e9 / device.update_rate));
  return std::clamp<std::chrono::nanoseconds>(period, haptics::kShortestTickPeriod, haptics::kLongestTickPeriod);
}

}  // namespace

Session run_session_offline(const HapticScene& scene, const geometry::PoseTrajectory& script_X_WH, std::int64_t ticks) {
  devices::SimulatedGlove glove(script_X_WH);
  haptics::Sliding sliding = start_sliding(scene, sliding_options(scene, glove.descriptor(), {}));
  SessionRecorder recorder(static_cast<std::size_t>(ticks));
  ProgressBar progress("offline", ticks);
  haptics::run_offline(glove, sliding, ticks, [&](const devices::HapticState& sample) {
    recorder.record(sample);
    progress.update(recorder.total());
  });
  return finished(ticks, haptics::kTickPeriod, scene, sliding, recorder, std::nullopt);
}

Session run_session(const HapticScene& scene, const std::shared_ptr<devices::LcmBus>& bus, const RunSettings& settings,
                    const std::function<bool()>& should_stop,
                    const std::function<void(std::int64_t, const std::string& news)>& watch) {
  const haptics::SlidingRules rules = haptics::real_time_rules();
  start_sliding(scene,
                sliding_options(scene, devices::simulated_glove_descriptor(), {}));  // errors come before waiting
  std::optional<devices::GloveInfo> info;
  while (!info && !should_stop()) {
    watch(0, "");
    info = devices::find_glove(bus, settings.device, std::chrono::milliseconds(100));
  }
  // Without a glove, the session below ends at once.
  const devices::DeviceDescriptor descriptor = info ? info->descriptor : devices::simulated_glove_descriptor();
  const std::chrono::nanoseconds period = settings.period.value_or(period_of(descriptor));
  if (period > period_of(descriptor))
    watch(0, "the glove is faster than the haptic loop: its force may fade (--rate-hz)");
  const std::int64_t ticks = std::llround(settings.seconds / std::chrono::duration<double>(period).count());
  haptics::Sliding sliding = start_sliding(scene, sliding_options(scene, descriptor, rules, period));
  SessionRecorder recorder(ticks > 0 ? static_cast<std::size_t>(ticks) : kKeptTicks);
  devices::HapticStatePublisher publisher(bus);
  devices::LcmGlove glove(bus, descriptor, {.device = settings.device, .glove_session = info ? info->session : 0});
  ReasonTeller teller;
  realtime::SteadyClock clock;

  haptics::HapticServer server(glove, sliding, clock,
                               [&](const devices::HapticState& sample) {
                                 recorder.record(sample);
                                 publisher.push(sample);
                                 teller.note(sample);
                               },
                               {.period = period, .ticks = ticks, .fifo_priority = kFifoPriority});
  realtime::PeriodicThread bare_timer(clock, {.period = period, .fifo_priority = kFifoPriority},
                                      [](const realtime::PeriodicTick&) { return true; });
  while (!server.is_done() && !server.has_failed() && !should_stop()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    watch(server.ticks(), teller.news());
  }
  server.stop();
  bare_timer.stop();
  if (server.has_failed()) throw std::runtime_error("the simulation failed: " + server.failure());
  return finished(server.ticks(), period, scene, sliding, recorder,
                  RealTimeFigures{server.statistics(), bare_timer.statistics()});
}

}  // namespace glissade::apps

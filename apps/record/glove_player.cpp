#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include <glissade/apps/record/glove_player.h>
#include <glissade/apps/record/log_file.h>
#include <glissade/devices/event_log.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_loop.h>

namespace glissade::apps {

namespace {

/// A recorded glove on the bus.
class Player {
 public:
  Player(const GloveTrack& track, const std::shared_ptr<devices::LcmBus>& bus)
      : track_(track),
        host_(bus, track.glove.descriptor, {.device = track.glove.device, .side = track.glove.side}),
        state_(track.samples.front().state) {
    state_.sequence = 0;
  }

  /// Between two states of the glove.
  std::chrono::nanoseconds period() const {
    return std::chrono::round<std::chrono::nanoseconds>(
        std::chrono::duration<double>(1.0 / track_.glove.descriptor.update_rate));
  }
  bool is_commanded() const { return host_.statistics().accepted > 0; }
  void stop() { host_.stop(); }

  /// Sends a state, if it is due `now`, at `time` of the track. Returns whether the glove has a force.
  bool step(std::chrono::nanoseconds time, std::chrono::nanoseconds now) {
    if (now < due_) return has_force_;
    due_ += period();
    if (due_ <= now) due_ = now + period();
    const devices::GloveCommand command = host_.newest_command(state_).values();
    played_.greatest_force_N = std::max(played_.greatest_force_N, command.f_H_W.norm());
    while (next_ + 1 < track_.samples.size() && track_.samples[next_ + 1].time <= time)
      ++next_;
    const std::int64_t sequence = state_.sequence + 1;
    state_ = track_.samples[next_].state;
    state_.sequence = sequence;
    state_.time = now;
    host_.publish(state_);
    ++played_.states;
    has_force_ = !command.f_H_W.isZero(0.0) || !command.t_H_W.isZero(0.0);
    return has_force_;
  }

  PlayedGlove played() const {
    PlayedGlove result = played_;
    result.device = track_.glove.device;
    result.commands = host_.statistics().accepted;
    return result;
  }

 private:
  const GloveTrack& track_;
  devices::LcmGloveHost host_;
  devices::GloveState state_;        // as sent
  std::size_t next_ = 0;             // the newest sample
  std::chrono::nanoseconds due_{0};  // the next state
  bool has_force_ = false;
  PlayedGlove played_;
};

}  // namespace

std::vector<GloveTrack> read_glove_tracks(const std::string& log_path, std::string& damage) {
  LogFile log(log_path, "gloves");
  std::map<std::int64_t, devices::GloveInfo> gloves;
  std::map<std::int64_t, std::vector<GloveTrack::Sample>> samples;
  constexpr std::chrono::milliseconds kNewClock(100);
  std::optional<std::chrono::microseconds> first;  // time of the log at the time 0 of the tracks
  std::chrono::microseconds newest{0};
  while (const std::optional<devices::LogEvent> event = log.next()) {
    if (const auto glove = devices::glove_info_of(*event)) gloves.try_emplace(glove->device, *glove);
    const auto logged = devices::glove_state_of(*event);
    if (!logged) continue;
    if (!first) first = event->time;
    // The clock of a joined log may begin anew: the gloves go on from where they were.
    if (event->time - *first < newest - kNewClock) first = event->time - newest;
    newest = std::max(newest, event->time - *first);
    samples[logged->device].push_back({event->time - *first, logged->state});
  }
  damage = log.damage();
  std::vector<GloveTrack> tracks;
  for (auto& [device, glove] : gloves) {
    if (samples.contains(device)) tracks.push_back({glove, std::move(samples[device])});
  }
  if (!tracks.empty()) return tracks;
  throw std::invalid_argument(log_path +
                              ": there is no glove to play: no number has both a GLOVE_INFO and a GLOVE_STATE "
                              "that this version can read");
}

std::chrono::nanoseconds duration_of(const std::vector<GloveTrack>& tracks) {
  std::chrono::nanoseconds duration{0};
  for (const GloveTrack& track : tracks)
    duration = std::max<std::chrono::nanoseconds>(duration, track.samples.back().time);
  return duration;
}

std::vector<PlayedGlove> play_gloves(const std::vector<GloveTrack>& tracks, const std::shared_ptr<devices::LcmBus>& bus,
                                     const std::function<bool()>& should_stop,
                                     const std::function<void(std::chrono::nanoseconds)>& watch) {
  constexpr int kLongestEnd = 100;  // periods, in which the force fades
  constexpr std::uint64_t kWatchPeriods = 100;
  constexpr std::chrono::nanoseconds kShortestPeriod(std::chrono::microseconds(100));
  std::vector<std::unique_ptr<Player>> players;
  for (const GloveTrack& track : tracks)
    players.push_back(std::make_unique<Player>(track, bus));
  const std::chrono::nanoseconds duration = duration_of(tracks);
  std::chrono::nanoseconds period(std::chrono::milliseconds(1));
  for (const auto& player : players)
    period = std::clamp(player->period(), kShortestPeriod, period);
  std::optional<std::chrono::nanoseconds> start;
  int ending_ticks = 0;
  realtime::SteadyClock clock;
  realtime::PeriodicStatistics statistics;
  realtime::run_periodic(clock, period, statistics, [&](const realtime::PeriodicTick& tick) {
    const bool is_commanded =
        std::any_of(players.begin(), players.end(), [](const auto& player) { return player->is_commanded(); });
    if (!start && is_commanded) start = tick.deadline;
    const std::chrono::nanoseconds time = start ? tick.deadline - *start : std::chrono::nanoseconds(0);
    if (tick.index % kWatchPeriods == 0) watch(std::min(time, duration));
    const bool is_ending = should_stop() || time > duration;
    bool has_force = false;
    for (const auto& player : players) {
      if (is_ending) player->stop();
      has_force = player->step(time, tick.deadline) || has_force;
    }
    return !is_ending || (has_force && ++ending_ticks < kLongestEnd);
  });
  std::vector<PlayedGlove> played;
  for (const auto& player : players)
    played.push_back(player->played());
  return played;
}

}  // namespace glissade::apps

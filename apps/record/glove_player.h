#pragma once

/// The recorded gloves, once more: on a bus, for a server in real time.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>

namespace glissade::apps {

/// The states of a glove in a log, by the time at which they were recorded.
struct GloveTrack {
  struct Sample {
    std::chrono::microseconds time{0};  ///< since the first state of any glove in the log
    devices::GloveState state;
  };
  devices::GloveInfo glove;
  std::vector<Sample> samples;  ///< at least one
};

/// The gloves of a log. Reads up to the first damage, of which `damage` then tells. Throws std::invalid_argument,
/// naming the file, when no glove has both an announcement and a state.
std::vector<GloveTrack> read_glove_tracks(const std::string& log_path, std::string& damage);

/// Duration of the longest track.
std::chrono::nanoseconds duration_of(const std::vector<GloveTrack>& tracks);

/// What was played.
struct PlayedGlove {
  std::int64_t device = 0;
  std::int64_t states = 0;        ///< sent
  std::uint64_t commands = 0;     ///< received
  double greatest_force_N = 0.0;  ///< that a hand would have felt
};

/// Sends the states at the rate of each glove and at the recorded times, as new ones: with new numbers and times, and
/// sessions of this program. All wait at their first states until a server commands one of them. Ends after the last
/// state, or when `should_stop` returns true. `watch` gets the played time, ten times a second. The commands have no
/// effect on the recorded hands.
std::vector<PlayedGlove> play_gloves(const std::vector<GloveTrack>& tracks, const std::shared_ptr<devices::LcmBus>& bus,
                                     const std::function<bool()>& should_stop,
                                     const std::function<void(std::chrono::nanoseconds)>& watch);

}  // namespace glissade::apps

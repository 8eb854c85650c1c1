#pragma once

/// What a bridge says about the tracker of the hand: that it is silent, slow, or back.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include <glissade/devices/hand_pose.h>

namespace glissade::bridges {

class PoseNotice {
 public:
  explicit PoseNotice(devices::HandPoseOptions options) : options_(options) {}

  /// A sentence when something has changed. `newest` is the time of the newest pose, on the clock of `now`. Call it in
  /// each period.
  std::optional<std::string> note(std::optional<std::chrono::nanoseconds> newest, const devices::LinkStatistics& link,
                                  std::chrono::nanoseconds now);

 private:
  enum class Tracker { kUnknown, kSilent, kHeard };

  std::optional<std::string> note_rate(std::uint64_t poses, std::chrono::nanoseconds now);

  devices::HandPoseOptions options_;
  Tracker tracker_ = Tracker::kUnknown;
  std::optional<std::chrono::nanoseconds> start_;
  std::chrono::nanoseconds counted_since_{0};
  std::uint64_t counted_ = 0;
  bool is_slow_told_ = false;
};

}  // namespace glissade::bridges

#include "hand_pose/pose_notice.h"

#include <cmath>
#include <utility>

namespace glissade::bridges {
namespace {

using std::chrono::nanoseconds;

constexpr std::chrono::milliseconds kSilentTracker{500};
constexpr std::chrono::seconds kCounted{5};
constexpr double kSlow = 0.9;  // of the rate; the rest may be lost on the way

std::string words_for(const devices::LinkStatistics& link) {
  std::string words;
  for (const std::string& refusal : devices::refusals_of(link))
    words += "; poses are refused: " + refusal;
  return words;
}

}  // namespace

std::optional<std::string> PoseNotice::note(std::optional<nanoseconds> newest, const devices::LinkStatistics& link,
                                            nanoseconds now) {
  if (!start_) start_ = now;
  const bool is_silent = now - newest.value_or(*start_) > kSilentTracker;
  const Tracker before = tracker_;
  if (is_silent) tracker_ = Tracker::kSilent;
  if (!is_silent && newest) tracker_ = Tracker::kHeard;
  if (tracker_ == before) return tracker_ == Tracker::kHeard ? note_rate(link.accepted, now) : std::nullopt;
  counted_since_ = now;
  counted_ = link.accepted;
  const std::string number = std::to_string(options_.device);
  if (tracker_ == Tracker::kHeard) return "the tracker of hand " + number + " is heard";
  if (!newest) return "waiting for a tracker of hand " + number + " on HAND_POSE" + words_for(link);
  return "the tracker of hand " + number + " is silent or does not see the hand: no force" + words_for(link);
}

std::optional<std::string> PoseNotice::note_rate(std::uint64_t poses, nanoseconds now) {
  if (now - counted_since_ < kCounted) return std::nullopt;
  const double passed_s = std::chrono::duration<double>(now - counted_since_).count();
  const double rate_Hz = static_cast<double>(poses - std::exchange(counted_, poses)) / passed_s;
  counted_since_ = now;
  if (rate_Hz >= kSlow * options_.rate_Hz || std::exchange(is_slow_told_, true)) return std::nullopt;
  return "the tracker sends " + std::to_string(std::lround(rate_Hz)) + " poses a second, fewer than the " +
         std::to_string(std::lround(options_.rate_Hz)) + " of --pose-rate-hz: the force fades between them";
}

}  // namespace glissade::bridges

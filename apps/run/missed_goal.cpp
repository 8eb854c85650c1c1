#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glissade/apps/durations.h>
#include <glissade/apps/run/missed_goal.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

/// From the first state on in which a hand is somewhere.
struct HandTimes {
  std::int64_t lost_ticks = 0;     ///< without a state for so long that nobody knows where the hand is
  std::int64_t waiting_ticks = 0;  ///< inside something
};

HandTimes times_of(const SessionRecorder& samples, std::size_t h) {
  HandTimes times;
  bool has_been_present = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const hands::HandActivity activity = samples.hand(i, h).visible.activity;
    has_been_present = has_been_present || hands::is_present(activity);
    if (!has_been_present) continue;
    times.lost_ticks += activity == hands::HandActivity::kLost ? 1 : 0;
    times.waiting_ticks += activity == hands::HandActivity::kWaiting ? 1 : 0;
  }
  return times;
}

bool is_held(const SessionRecorder& samples, std::size_t i) {
  for (std::size_t h = 0; h < samples.hands(); ++h)
    if (samples.hand(i, h).part == 0) return true;
  return false;
}

/// The last tick in which a hand holds the first part.
std::optional<std::size_t> last_held(const SessionRecorder& samples) {
  for (std::size_t i = samples.size(); i > 0; --i)
    if (is_held(samples, i - 1)) return i - 1;
  return std::nullopt;
}

std::string text_mm(double metres) {
  return fixed_text(1e3 * metres, 1) + " mm";
}

std::string what_hands_did(const Session& session, const HapticScene& scene) {
  const SessionRecorder& samples = *session.samples;
  const std::optional<std::size_t> last = last_held(samples);
  if (!last) return "no hand ever held it";
  const devices::HapticPartState& part = samples.part(*last, 0);
  if (*last + 1 < samples.size()) {
    const double since_start = in_seconds(samples.tick(*last).time - samples.tick(0).time);
    const double distance = (part.X_WV.translation() - scene.X_WGoal->translation()).norm();
    return "it was let go at " + fixed_text(since_start, 2) + " s, " + text_mm(distance) + " from the goal";
  }
  return "at the end it was " + std::string(devices::name_of(part.state)) + ", " + text_mm(part.lag().v.norm()) +
         " from where the hand wanted it";
}

}  // namespace

std::string why_goal_is_missed(const SessionSummary& summary, const Session& session, const HapticScene& scene) {
  const SessionRecorder& samples = *session.samples;
  std::vector<std::string> causes{what_hands_did(session, scene)};
  const auto text_s = [&](std::int64_t ticks) {
    return fixed_text(in_seconds(session.period) * static_cast<double>(ticks), 2) + " s";
  };
  for (std::size_t h = 0; h < samples.hands(); ++h) {
    const HandTimes times = times_of(samples, h);
    const std::string hand = samples.hands() == 1 ? "the hand" : "hand " + std::to_string(h + 1);
    if (times.lost_ticks > 0)
      causes.push_back(hand + " was lost for " + text_s(times.lost_ticks) + " because its states came late");
    if (times.waiting_ticks > 0) causes.push_back(hand + " was inside something for " + text_s(times.waiting_ticks));
  }
  std::int64_t old_ticks = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    old_ticks += samples.tick(i).contact_set_age > haptics::kFullForce ? 1 : 0;
  if (old_ticks > 0) causes.push_back("contacts were older than 20 ms for " + text_s(old_ticks));
  return in_quotes(summary.parts.front().name) + " missed its goal by " + text_mm(summary.goal_distance_m) + ": " +
         joined(causes, "; ");
}

}  // namespace glissade::apps

#include <utility>

#include <glissade/apps/run/force_reason.h>
#include <glissade/apps/run/glove_watch.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

void GloveWatch::note(std::chrono::nanoseconds time, const devices::SafeCommand& command) noexcept {
  if (!std::exchange(has_noted_, true)) noted_.start = time;
  reasons_.note(time, force_reason(command));
  noted_.command = command;
  newest_.publish(noted_);
}

std::vector<std::string> GloveWatch::events() {
  has_news_ = newest_.update() || has_news_;
  std::vector<std::string> events;
  for (const TimedSentence& sentence : reasons_.news()) {
    const std::chrono::duration<double> since_start = sentence.time - newest_.value().start;
    events.push_back(fixed_text(since_start.count(), 3) + " s: " + sentence.text);
  }
  return events;
}

std::string GloveWatch::status(std::chrono::nanoseconds script_time, std::chrono::nanoseconds duration) {
  has_news_ = newest_.update() || has_news_;
  if (!has_news_) return {};
  const auto seconds = [](std::chrono::duration<double> time) { return fixed_text(time.count(), 1); };
  const devices::SafeCommand& command = newest_.value().command;
  const double force = command.values().f_H_W.norm();
  const std::string reason = to_text(force_reason(command));
  std::string text = seconds(script_time) + " of " + seconds(duration) + " s of the script: ";
  if (force == 0.0 && !reason.empty()) return text + reason;
  text += fixed_text(force, 1) + " N";
  return reason.empty() ? text : text + ", " + reason;
}

}  // namespace glissade::apps

#include <exception>

#include <glissade/apps/record/run_recorders.h>
#include <glissade/apps/text.h>
#include <glissade/files/file_checks.h>

namespace glissade::apps {

void validate(const RecordSettings& settings) {
  constexpr bool kTakesAFreeName = true;
  if (!settings.log.empty()) check_recording(settings.log, settings.overwrites);
  if (!settings.flight.empty()) check_recording(settings.flight, kTakesAFreeName);
}

RunRecorders::RunRecorders(const RecordSettings& settings, const RecordedSession& session) {
  std::vector<haptics::LoopObserver*> observers;
  if (!settings.log.empty()) observers.push_back(&log_.emplace(settings.log, head_of(session)));
  if (!settings.flight.empty()) observers.push_back(&flight_.emplace(settings.flight, head_of(session)));
  if (!observers.empty()) background_ = std::make_unique<haptics::BackgroundObserver>(observers);
}

RunRecorders::~RunRecorders() = default;

std::vector<std::string> RunRecorders::write_flight(bool is_requested) {
  if (!flight_ || (!is_requested && !flight_->is_due())) return {};
  return {flight_->write()};
}

std::vector<std::string> RunRecorders::finish(bool has_failed) {
  if (!background_) return {};
  const std::uint64_t dropped = background_->dropped();
  background_.reset();
  std::vector<std::string> sentences = flight_ && has_failed ? std::vector{flight_->write(true)} : write_flight(false);
  if (dropped > 0) {
    sentences.push_back(std::to_string(dropped) +
                        " ticks and contact sets were not recorded, because the disk was too slow");
  }
  if (!log_) return sentences;
  is_whole_ = dropped == 0;
  try {
    log_->close();
  } catch (const std::exception& error) {
    is_whole_ = false;
    sentences.emplace_back(error.what());
  }
  return sentences;
}

}  // namespace glissade::apps

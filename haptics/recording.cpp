#include <stdexcept>

#include <glissade/haptics/recording.h>

namespace glissade::haptics {

namespace {

/// Whether the work ends without an exception. There may be no memory for an event.
template <typename Work>
bool succeeds(const Work& work) noexcept {
  try {
    work();
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace

BackgroundObserver::BackgroundObserver(std::vector<LoopObserver*> observers)
    : observers_(std::move(observers)), ticks_(2048), answers_(1024) {
  constexpr std::chrono::milliseconds kPeriod(5);
  batch_.reserve(ticks_.capacity());
  thread_ = std::make_unique<realtime::PeriodicThread>(
      clock_, realtime::PeriodicThreadOptions{.period = kPeriod, .name = "recorder"},
      [this](const realtime::PeriodicTick&) {
        pass_on();
        return true;
      });
}

BackgroundObserver::~BackgroundObserver() {
  thread_->stop();
  pass_on();
}

/// The ticks leave their ring first: then the answers that they used are in the other.
void BackgroundObserver::pass_on() noexcept {
  batch_.clear();
  ticks_.pop_waiting([this](const TickRecord& record) { batch_.push_back(record); });
  answers_.pop_waiting([this](const AnswerRecord& record) {
    for (LoopObserver* observer : observers_)
      observer->after_answer(record);
  });
  for (const TickRecord& record : batch_) {
    for (LoopObserver* observer : observers_)
      observer->after_tick(record);
  }
}

LogRecorder::LogRecorder(const std::string& path, RecordingHead head)
    : path_(path), events_(std::move(head)), file_(path) {
  for (const devices::LogEvent& event : events_.at_start())
    file_.write(event);
}

void LogRecorder::after_tick(const TickRecord& record) noexcept {
  const bool is_written = succeeds([&] {
    for (const devices::LogEvent& event : events_.of(record))
      file_.write(event);
  });
  is_incomplete_ = is_incomplete_ || !is_written;
}

void LogRecorder::after_answer(const AnswerRecord& record) noexcept {
  const bool is_written = succeeds([&] { file_.write(RecordedEvents::of(record)); });
  is_incomplete_ = is_incomplete_ || !is_written;
}

void LogRecorder::close() {
  file_.close();
  if (is_incomplete_) throw std::runtime_error(path_ + ": events are missing, because there was no memory for them");
}

FlightRecorder::FlightRecorder(RecordingHead head, std::size_t most_bytes)
    : events_(std::move(head)), most_bytes_(most_bytes) {}

// An event that finds no memory is lost: the others are still worth having.
void FlightRecorder::after_tick(const TickRecord& record) noexcept {
  succeeds([&] {
    for (devices::LogEvent& event : events_.of(record))
      keep(std::move(event));
  });
}

void FlightRecorder::after_answer(const AnswerRecord& record) noexcept {
  succeeds([&] { keep(RecordedEvents::of(record)); });
}

void FlightRecorder::keep(devices::LogEvent event) {
  const auto size_of = [](const devices::LogEvent& kept) {
    return sizeof(devices::LogEvent) + kept.channel.size() + kept.message.size();
  };
  const std::scoped_lock lock(mutex_);
  kept_.push_back(std::move(event));
  bytes_ += size_of(kept_.back());
  while (bytes_ > most_bytes_) {
    bytes_ -= size_of(kept_.front());
    kept_.pop_front();
  }
}

void FlightRecorder::write(const std::string& path) const {
  devices::EventLogWriter file(path);
  for (const devices::LogEvent& event : events_.at_start())
    file.write(event);
  std::deque<devices::LogEvent> events;
  {
    const std::scoped_lock lock(mutex_);
    events = kept_;
  }
  for (const devices::LogEvent& event : events)
    file.write(event);
  file.close();
}

}  // namespace glissade::haptics

#include <filesystem>

#include <glissade/apps/record/log_file.h>
#include <glissade/apps/text.h>
#include <glissade/files/file_checks.h>

namespace glissade::apps {

namespace {

const std::string& checked(const std::string& path) {
  check_input(path);
  return path;
}

}  // namespace

LogFile::LogFile(const std::string& path, const std::string& label)
    : path_(checked(path)),
      reader_(path),
      progress_(label, static_cast<std::int64_t>(std::filesystem::file_size(path))) {}

std::optional<devices::LogEvent> LogFile::next() {
  constexpr std::int64_t kHeaderBytes = 28;
  std::optional<devices::LogEvent> event = reader_.next();
  if (event) ++events_;
  if (event) bytes_ += kHeaderBytes + std::ssize(event->channel) + std::ssize(event->message);
  progress_.update(bytes_);
  return event;
}

void LogFile::note_unreadable(const devices::LogEvent& event) {
  if (++unreadable_ == 1) first_unreadable_ = "event " + std::to_string(events_) + ", on " + event.channel;
}

std::string LogFile::damage() const {
  if (!reader_.damage().empty() || unreadable_ == 0) return reader_.damage();
  const std::string count = unreadable_ == 1 ? "1 event" : std::to_string(unreadable_) + " events";
  return path_ + ": " + count + " cannot be read, whose bytes were changed or are of another version; the first is " +
         first_unreadable_;
}

}  // namespace glissade::apps

#include <algorithm>
#include <bit>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <glissade/base/byte_order.h>
#include <glissade/devices/event_log.h>

namespace glissade::devices {

namespace {

// An event: sync word, number, time, lengths of channel and message, channel, message; all numbers big-endian.
constexpr std::string_view kSync = "\xED\xA1\xDA\x01";
constexpr std::size_t kHeaderBytes = 28;
constexpr std::int32_t kLongestChannel = 63;         // LCM_MAX_CHANNEL_NAME_LENGTH
constexpr std::int32_t kLongestMessage = 256 << 20;  // bytes
constexpr std::size_t kBufferBytes = 256 << 10;      // an event has some hundreds or thousands

/// Without the number: joined logs count from the beginning more than once, and logs with gaps are logs too.
struct Header {
  std::int64_t time_us;
  std::int32_t channel_bytes;
  std::int32_t message_bytes;
};

Header header_of(std::string_view bytes) {
  const auto order = std::endian::big;
  return {base::number_at<std::int64_t>(bytes, 12, order), base::number_at<std::int32_t>(bytes, 20, order),
          base::number_at<std::int32_t>(bytes, 24, order)};
}

/// Whether another event begins within this one, whose last bytes may follow it.
bool holds_sync(const LogEvent& event, std::string_view following) {
  std::string bytes = event.channel;
  bytes.append(event.message.begin(), event.message.end());
  return bytes.append(following).find(kSync) != std::string::npos;
}

bool is_control(char c) {
  return (c >= '\0' && c < ' ') || c == '\x7f';
}

}  // namespace

EventLogWriter::EventLogWriter(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw std::invalid_argument(path + ": cannot be created");
}

void EventLogWriter::write(const LogEvent& event) {
  std::string bytes;
  bytes.reserve(kHeaderBytes + event.channel.size() + event.message.size());
  const auto order = std::endian::big;
  bytes += kSync;
  base::append_number(bytes, written_++, order);
  base::append_number(bytes, static_cast<std::int64_t>(event.time.count()), order);
  base::append_number(bytes, static_cast<std::int32_t>(event.channel.size()), order);
  base::append_number(bytes, static_cast<std::int32_t>(event.message.size()), order);
  bytes += event.channel;
  bytes.append(event.message.begin(), event.message.end());
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void EventLogWriter::close() {
  file_.close();
  if (!file_) throw std::runtime_error(path_ + ": not everything could be written; is the disk full?");
}

EventLogReader::EventLogReader(const std::string& path) : path_(path), buffer_(kBufferBytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw std::invalid_argument(path + ": there is no such file");
  if (!std::filesystem::exists(status)) throw std::invalid_argument(path + ": " + error.message());
  if (std::filesystem::is_directory(status)) throw std::invalid_argument(path + ": is a folder, not an event log");
  if (!std::filesystem::is_regular_file(status)) throw std::invalid_argument(path + ": is not a regular file");
  file_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file_.open(path, std::ios::binary);
  if (!file_) throw std::invalid_argument(path + ": cannot be read");
  size_ = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (error || !read(kSync.size(), ahead_) || ahead_ != kSync)
    throw std::invalid_argument(path + ": is no LCM event log");
}

std::optional<LogEvent> EventLogReader::next() {
  if (!damage_.empty() || offset_ == size_) return std::nullopt;
  if (ahead_ != kSync.substr(0, ahead_.size())) return damaged(offset_, "no event begins here");
  std::string rest;
  if (!read(kHeaderBytes - kSync.size(), rest)) return damaged(offset_, "the file ends within an event");
  const Header header = header_of(ahead_ + rest);
  if (header.channel_bytes < 1 || header.channel_bytes > kLongestChannel) {
    return damaged(offset_ + 20, "a channel's name cannot have " + std::to_string(header.channel_bytes) + " bytes");
  }
  const std::int64_t left = size_ - offset_ - static_cast<std::int64_t>(kHeaderBytes) - header.channel_bytes;
  if (header.message_bytes < 0 || header.message_bytes > kLongestMessage) {
    return damaged(offset_ + 24, "a message cannot have " + std::to_string(header.message_bytes) + " bytes");
  }
  if (header.message_bytes > left) return damaged(offset_, "the file ends within an event");

  LogEvent event;
  event.time = std::chrono::microseconds(header.time_us);
  if (!read(static_cast<std::size_t>(header.channel_bytes), event.channel) ||
      std::any_of(event.channel.begin(), event.channel.end(), is_control)) {
    return damaged(offset_ + static_cast<std::int64_t>(kHeaderBytes), "a channel's name has control characters");
  }
  event.message.resize(static_cast<std::size_t>(header.message_bytes));
  if (!file_.read(reinterpret_cast<char*>(event.message.data()), header.message_bytes))
    return damaged(offset_, "the file cannot be read on");
  read(kSync.size(), ahead_);
  const bool has_more = header.message_bytes < left;
  if (has_more && ahead_ != kSync && holds_sync(event, ahead_))
    return damaged(offset_, "the event is cut short by another one");
  offset_ += static_cast<std::int64_t>(kHeaderBytes) + header.channel_bytes + header.message_bytes;
  ++count_;
  return event;
}

bool EventLogReader::read(std::size_t size, std::string& bytes) {
  bytes.resize(size);
  file_.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file_.gcount()));
  return bytes.size() == size;
}

std::optional<LogEvent> EventLogReader::damaged(std::int64_t offset, const std::string& what) {
  damage_ = path_ + ": damaged at byte " + std::to_string(offset) + ", after " + std::to_string(count_) +
            " whole events: " + what;
  return std::nullopt;
}

}  // namespace glissade::devices

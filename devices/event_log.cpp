#include <algorithm>
#include <bit>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <glissade/base/byte_order.h>
#include <glissade/devices/event_log.h>

namespace glissade::devices {

namespace {

// An event: sync word, number, time, lengths of channel and message, channel, message; all numbers big-endian.
constexpr std::uint32_t kSync = 0xEDA1DA01;
constexpr std::size_t kHeaderBytes = 28;
constexpr std::int32_t kLongestChannel = 63;         // LCM_MAX_CHANNEL_NAME_LENGTH
constexpr std::int32_t kLongestMessage = 256 << 20;  // bytes
constexpr std::size_t kBufferBytes = 256 << 10;      // an event has some hundreds or thousands

struct Header {
  std::uint32_t sync;
  std::int64_t number;
  std::int64_t time_us;
  std::int32_t channel_bytes;
  std::int32_t message_bytes;
};

Header header_of(std::string_view bytes) {
  const auto order = std::endian::big;
  return {base::number_at<std::uint32_t>(bytes, 0, order), base::number_at<std::int64_t>(bytes, 4, order),
          base::number_at<std::int64_t>(bytes, 12, order), base::number_at<std::int32_t>(bytes, 20, order),
          base::number_at<std::int32_t>(bytes, 24, order)};
}

bool is_printable(char c) {
  return c > ' ' && c < '\x7f';
}

}  // namespace

EventLogWriter::EventLogWriter(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw std::invalid_argument(path + ": cannot be created");
}

void EventLogWriter::write(const LogEvent& event) {
  std::string bytes;
  bytes.reserve(kHeaderBytes + event.channel.size() + event.message.size());
  const auto order = std::endian::big;
  base::append_number(bytes, kSync, order);
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
  file_.rdbuf()->pubsetbuf(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file_.open(path, std::ios::binary);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw std::invalid_argument(path + ": there is no such file");
  if (std::filesystem::is_directory(path, error)) throw std::invalid_argument(path + ": is a folder, not an event log");
  if (!file_) throw std::invalid_argument(path + ": cannot be read");
  size_ = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  std::string sync;
  if (error || !read(sizeof kSync, sync) || base::number_at<std::uint32_t>(sync, 0, std::endian::big) != kSync) {
    throw std::invalid_argument(path + ": is no LCM event log");
  }
  file_.seekg(0);
}

std::optional<LogEvent> EventLogReader::next() {
  if (!damage_.empty() || offset_ == size_) return std::nullopt;
  std::string bytes;
  if (!read(kHeaderBytes, bytes)) return damaged(offset_, "the file ends within an event");
  const Header header = header_of(bytes);
  if (header.sync != kSync) return damaged(offset_, "no event begins here");
  if (!first_number_) first_number_ = header.number;
  if (header.number != *first_number_ + count_)
    return damaged(offset_ + 4, "the numbers of the events do not rise by 1");
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
      !std::all_of(event.channel.begin(), event.channel.end(), is_printable)) {
    return damaged(offset_ + static_cast<std::int64_t>(kHeaderBytes),
                   "a channel's name has other characters than a word");
  }
  event.message.resize(static_cast<std::size_t>(header.message_bytes));
  if (!file_.read(reinterpret_cast<char*>(event.message.data()), header.message_bytes))
    return damaged(offset_, "the file cannot be read on");
  offset_ += static_cast<std::int64_t>(kHeaderBytes) + header.channel_bytes + header.message_bytes;
  ++count_;
  return event;
}

bool EventLogReader::read(std::size_t size, std::string& bytes) {
  bytes.resize(size);
  return static_cast<bool>(file_.read(bytes.data(), static_cast<std::streamsize>(size)));
}

std::optional<LogEvent> EventLogReader::damaged(std::int64_t offset, const std::string& what) {
  damage_ = path_ + ": damaged at byte " + std::to_string(offset) + ", after " + std::to_string(count_) +
            " whole events: " + what;
  return std::nullopt;
}

}  // namespace glissade::devices

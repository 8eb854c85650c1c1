#include <algorithm>
#include <stdexcept>

#include <glissade/apps/record/mcap_writer.h>
#include <glissade/apps/text.h>
#include <glissade/base/byte_order.h>
#include <glissade/files/file_checks.h>

namespace glissade::apps {

namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
constexpr std::size_t kChunkSize = 1U << 20U;  // from this size on, a chunk is written

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// The content of a record. Texts, arrays and maps begin with their size in bytes.
class Fields {
 public:
  template <typename Number>
  Fields& add(Number number) {
    base::append_number(bytes_, number);
    return *this;
  }
  Fields& text(std::string_view text) { return add(static_cast<std::uint32_t>(text.size())).raw(text); }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  Fields& map(const std::map<std::uint16_t, std::uint64_t>& map) {
    Fields entries;
    for (const auto& [key, value] : map)
      entries.add(key).add(value);
    return text(entries.bytes_);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(Opcode opcode, std::string_view content) {
  Fields all;
  all.add(opcode).add(std::uint64_t{content.size()}).raw(content);
  return all.bytes();
}

std::uint32_t crc_of(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

}  // namespace

void McapWriter::Span::include(std::uint64_t time) {
  first = is_empty ? time : std::min(first, time);
  last = is_empty ? time : std::max(last, time);
  is_empty = false;
}

McapWriter::McapWriter(const std::string& path) : path_(path), file_(open_output(path)) {
  put(kMagic);
  put(record(Opcode::kHeader, Fields().text("").text("glissade").bytes()));  // no profile; the library
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& schema_name,
                                      const std::string& json_schema) {
  const auto next_schema = static_cast<std::uint16_t>(schema_numbers_.size() + 1);  // 0 means none
  const auto [schema, is_new] = schema_numbers_.try_emplace(schema_name, next_schema);
  if (is_new) {
    const std::string bytes = record(
        Opcode::kSchema, Fields().add(next_schema).text(schema_name).text("jsonschema").text(json_schema).bytes());
    schemas_ += bytes;
    chunk_ += bytes;
  }
  const auto channel = static_cast<std::uint16_t>(counts_.size());
  const std::string bytes =
      record(Opcode::kChannel, Fields().add(channel).add(schema->second).text(topic).text("json").map({}).bytes());
  channels_ += bytes;
  chunk_ += bytes;
  counts_[channel] = 0;
  return channel;
}

void McapWriter::write(std::uint16_t channel, std::chrono::nanoseconds time, std::string_view json) {
  const auto log_time = static_cast<std::uint64_t>(time.count());
  const auto sequence = static_cast<std::uint32_t>(counts_.at(channel)++);
  chunk_messages_[channel].emplace_back(log_time, chunk_.size());
  chunk_span_.include(log_time);
  span_.include(log_time);
  // The time of publication is the time of the record.
  chunk_ += record(Opcode::kMessage, Fields().add(channel).add(sequence).add(log_time).add(log_time).raw(json).bytes());
  if (chunk_.size() >= kChunkSize) end_chunk();
}

void McapWriter::close() {
  if (!chunk_.empty()) end_chunk();
  put(record(Opcode::kDataEnd, Fields().add(std::uint32_t{crc_.checksum()}).bytes()));

  const std::uint64_t summary_start = offset_;
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_)
    messages += count;
  Fields statistics;
  statistics.add(messages).add(static_cast<std::uint16_t>(schema_numbers_.size()));
  statistics.add(static_cast<std::uint32_t>(counts_.size()));
  statistics.add(std::uint32_t{0}).add(std::uint32_t{0}).add(chunk_count_);  // no attachments, no metadata
  statistics.add(span_.first).add(span_.last).map(counts_);
  std::string summary;
  std::string offsets;
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    const std::uint64_t start = summary_start + summary.size();
    offsets +=
        record(Opcode::kSummaryOffset, Fields().add(opcode).add(start).add(std::uint64_t{records.size()}).bytes());
    summary += records;
  };
  add_group(Opcode::kSchema, schemas_);
  add_group(Opcode::kChannel, channels_);
  add_group(Opcode::kStatistics, record(Opcode::kStatistics, statistics.bytes()));
  add_group(Opcode::kChunkIndex, chunk_indexes_);

  const std::uint64_t offsets_start = summary_start + summary.size();
  std::string footer =
      record(Opcode::kFooter, Fields().add(summary_start).add(offsets_start).add(std::uint32_t{0}).bytes());
  footer.resize(footer.size() - sizeof(std::uint32_t));
  const std::string end = summary + offsets + footer;
  put(end);
  put(Fields().add(crc_of(end)).bytes());
  put(kMagic);
  file_.close();
  if (!file_) throw std::runtime_error(path_ + ": not everything could be written");
}

void McapWriter::put(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  crc_.process_bytes(bytes.data(), bytes.size());
  offset_ += bytes.size();
}

void McapWriter::end_chunk() {
  const std::uint64_t start = offset_;
  const std::uint64_t size = chunk_.size();
  Fields chunk;
  chunk.add(chunk_span_.first).add(chunk_span_.last).add(size).add(crc_of(chunk_)).text("").add(size).raw(chunk_);
  put(record(Opcode::kChunk, chunk.bytes()));
  const std::uint64_t length = offset_ - start;

  std::map<std::uint16_t, std::uint64_t> index_offsets;
  for (const auto& [channel, messages] : chunk_messages_) {
    index_offsets[channel] = offset_;
    Fields entries;
    for (const auto& [time, place] : messages)
      entries.add(time).add(place);
    put(record(Opcode::kMessageIndex, Fields().add(channel).text(entries.bytes()).bytes()));
  }
  Fields index;
  index.add(chunk_span_.first).add(chunk_span_.last).add(start).add(length);
  index.map(index_offsets).add(offset_ - start - length).text("").add(size).add(size);
  chunk_indexes_ += record(Opcode::kChunkIndex, index.bytes());
  ++chunk_count_;
  chunk_.clear();
  chunk_span_ = {};
  chunk_messages_.clear();
}

}  // namespace glissade::apps

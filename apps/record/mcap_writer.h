#pragma once

/// A writer of MCAP (https://mcap.dev/spec), the container of timed messages that Foxglove and PlotJuggler read.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/crc.hpp>

namespace glissade::apps {

/// Writes a file of messages in JSON: chunks without compression with indexes and checksums, then a summary by which a
/// reader finds any moment without reading the rest. Memory: a chunk, and 100 bytes for each one written. Not
/// thread-safe; may block.
class McapWriter {
 public:
  /// Throws std::invalid_argument, naming the file, when it cannot be created.
  explicit McapWriter(const std::string& path);

  /// Announces a channel, whose messages have the form that this JSON Schema describes; returns its number. Channels
  /// with the same name of their schema share it.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name, const std::string& json_schema);

  /// Appends a message that was recorded at `time` ≥ 0. The times of messages may be in any order. A failure is told by
  /// `close`.
  void write(std::uint16_t channel, std::chrono::nanoseconds time, std::string_view json);

  /// Number of messages of a channel so far.
  std::uint64_t count(std::uint16_t channel) const { return counts_.at(channel); }

  /// Writes the summary and ends the file. Throws std::runtime_error, naming the file, when not everything could be
  /// written. The destructor neither ends the file nor reports a failure.
  void close();

 private:
  /// First and last time of messages.
  struct Span {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    bool is_empty = true;
    void include(std::uint64_t time);
  };

  void put(std::string_view bytes);
  void end_chunk();

  std::string path_;
  std::ofstream file_;
  std::uint64_t offset_ = 0;
  boost::crc_32_type crc_;  // of the file so far

  // The chunk that is being filled: its records, and where each channel's messages are in it.
  std::string chunk_;
  Span chunk_span_;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;

  // For the summary.
  std::map<std::string, std::uint16_t> schema_numbers_;
  std::string schemas_;
  std::string channels_;
  std::string chunk_indexes_;
  std::uint32_t chunk_count_ = 0;
  Span span_;
  std::map<std::uint16_t, std::uint64_t> counts_;
};

}  // namespace glissade::apps

#pragma once

/// The host's end of a bus of Dynamixel servos: instructions, and the answers to them.

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glissade/bridges/byte_stream.h>
#include <glissade/realtime/clock.h>

#include "dynamixel/packet.h"
#include "dynamixel/status.h"

namespace glissade::bridges::dynamixel {

struct BusSettings {
  double baud_rate = 3e6;  ///< bits per second; a byte has ten bits
  /// The longest time to an answer, in addition to the time on the line: return delay and latency of the adapter.
  std::chrono::nanoseconds patience{std::chrono::milliseconds(5)};
};

/// The answer of a servo.
struct Answer {
  std::uint8_t error = 0;  ///< see status.h
  std::string data;        ///< as many bytes as requested, or none if there is an error
};

struct PingAnswer {
  std::uint16_t model = 0;
  std::uint8_t firmware = 0;
};

struct SyncWriteEntry {
  std::uint8_t id = 0;
  std::string data;
};

/// Writes to several servos, without answers. All entries, of which there is one at least, must have the same number of
/// bytes.
Packet sync_write_instruction(std::uint16_t address, std::span<const SyncWriteEntry> entries);

/// What a bus has seen so far.
struct BusStatistics {
  std::uint64_t answers = 0;
  std::uint64_t missing_answers = 0;
  std::uint64_t wrong_checksums = 0;
  std::uint64_t skipped_bytes = 0;  ///< garbage, cut packets and late answers
};

/// Each function sends one instruction and waits for its answers, except `sync_write`, which has none. Echoes of own
/// instructions, garbage and answers of other servos are ignored. A missing answer is no exception, because it can
/// happen at any time. All functions throw WireError if the line is gone, and may block until the patience is over.
class ServoBus {
 public:
  /// `line` and `clock` must outlive the bus.
  ServoBus(ByteStream& line, realtime::Clock& clock, const BusSettings& settings);

  std::optional<PingAnswer> ping(std::uint8_t id);
  std::optional<Answer> read(std::uint8_t id, std::uint16_t address, std::uint16_t size);
  std::optional<Answer> write(std::uint8_t id, std::uint16_t address, std::string_view data);
  std::optional<Answer> reboot(std::uint8_t id);

  /// One answer per servo, in the order of `ids`. Each servo sends a packet.
  std::vector<std::optional<Answer>> sync_read(std::span<const std::uint8_t> ids, std::uint16_t address,
                                               std::uint16_t size);
  /// The same with one packet from all servos, which takes less time. If one servo is missing, so are those after it.
  std::vector<std::optional<Answer>> fast_sync_read(std::span<const std::uint8_t> ids, std::uint16_t address,
                                                    std::uint16_t size);
  /// See `sync_write_instruction`. Does nothing without entries.
  void sync_write(std::uint16_t address, std::span<const SyncWriteEntry> entries);

  BusStatistics statistics() const noexcept;

 private:
  void send(const Packet& instruction, std::size_t answer_bytes);
  std::optional<Packet> next_answer();
  std::optional<Answer> answer_of(std::uint8_t id, std::size_t size);

  ByteStream& line_;
  realtime::Clock& clock_;
  BusSettings settings_;
  PacketDecoder decoder_;
  std::chrono::nanoseconds deadline_{0};  // of the answers to the last instruction
  std::uint64_t answers_ = 0;
  std::uint64_t missing_answers_ = 0;
};

}  // namespace glissade::bridges::dynamixel

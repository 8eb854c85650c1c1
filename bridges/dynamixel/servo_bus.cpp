#include "dynamixel/servo_bus.h"

#include <algorithm>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/base/byte_order.h>

namespace glissade::bridges::dynamixel {
namespace {

constexpr std::size_t kStatusOverhead = 11;  // bytes of an answer beside its data
constexpr double kBitsPerByte = 10.0;        // with start and stop bit

std::string address_and_size(std::uint16_t address, std::size_t size) {
  std::string parameters;
  base::append_number(parameters, address);
  base::append_number(parameters, static_cast<std::uint16_t>(size));
  return parameters;
}

std::string sync_read_parameters(std::span<const std::uint8_t> ids, std::uint16_t address, std::uint16_t size) {
  std::string parameters = address_and_size(address, size);
  for (const std::uint8_t id : ids)
    parameters.push_back(static_cast<char>(id));
  return parameters;
}

Answer to_answer(const Packet& packet) {
  return {static_cast<std::uint8_t>(packet.parameters[0]), packet.parameters.substr(1)};
}

}  // namespace

Packet sync_write_instruction(std::uint16_t address, std::span<const SyncWriteEntry> entries) {
  std::string parameters = address_and_size(address, entries[0].data.size());
  for (const SyncWriteEntry& entry : entries) {
    GLISSADE_ASSERT(entry.data.size() == entries[0].data.size());
    parameters.push_back(static_cast<char>(entry.id));
    parameters += entry.data;
  }
  return {kBroadcastId, Instruction::kSyncWrite, parameters};
}

ServoBus::ServoBus(ByteStream& line, realtime::Clock& clock, const BusSettings& settings)
    : line_(line), clock_(clock), settings_(settings) {}

BusStatistics ServoBus::statistics() const noexcept {
  return {answers_, missing_answers_, decoder_.wrong_checksums(), decoder_.skipped_bytes()};
}

void ServoBus::send(const Packet& instruction, std::size_t answer_bytes) {
  // What is still on its way answers an earlier instruction.
  decoder_.push(line_.read(std::chrono::nanoseconds(0)));
  decoder_.clear();
  const std::string bytes = encode(instruction);
  line_.write(bytes);
  const double on_line_s = static_cast<double>(bytes.size() + answer_bytes) * kBitsPerByte / settings_.baud_rate;
  deadline_ = clock_.now() + settings_.patience + std::chrono::nanoseconds(static_cast<std::int64_t>(on_line_s * 1e9));
}

/// The next answer of any servo; no value at the deadline.
std::optional<Packet> ServoBus::next_answer() {
  while (true) {
    while (std::optional<Packet> packet = decoder_.next()) {
      // Everything else is an echo of an instruction.
      if (packet->instruction == Instruction::kStatus && !packet->parameters.empty()) return packet;
    }
    const std::chrono::nanoseconds now = clock_.now();
    if (now >= deadline_) return std::nullopt;
    decoder_.push(line_.read(deadline_ - now));
  }
}

std::optional<Answer> ServoBus::answer_of(std::uint8_t id, std::size_t size) {
  while (const std::optional<Packet> packet = next_answer()) {
    if (packet->id != id) continue;
    Answer answer = to_answer(*packet);
    if (answer.data.size() != size && error_number(answer.error) == StatusError::kNone) continue;
    ++answers_;
    return answer;
  }
  ++missing_answers_;
  return std::nullopt;
}

std::optional<PingAnswer> ServoBus::ping(std::uint8_t id) {
  constexpr std::size_t kSize = 3;
  send({id, Instruction::kPing, {}}, kStatusOverhead + kSize);
  const std::optional<Answer> answer = answer_of(id, kSize);
  if (!answer || answer->data.size() != kSize) return std::nullopt;
  return PingAnswer{base::number_at<std::uint16_t>(answer->data, 0), static_cast<std::uint8_t>(answer->data[2])};
}

std::optional<Answer> ServoBus::read(std::uint8_t id, std::uint16_t address, std::uint16_t size) {
  send({id, Instruction::kRead, address_and_size(address, size)}, kStatusOverhead + size);
  return answer_of(id, size);
}

std::optional<Answer> ServoBus::write(std::uint8_t id, std::uint16_t address, std::string_view data) {
  std::string parameters;
  base::append_number(parameters, address);
  send({id, Instruction::kWrite, parameters.append(data)}, kStatusOverhead);
  return answer_of(id, 0);
}

std::optional<Answer> ServoBus::reboot(std::uint8_t id) {
  send({id, Instruction::kReboot, {}}, kStatusOverhead);
  return answer_of(id, 0);
}

std::vector<std::optional<Answer>> ServoBus::sync_read(std::span<const std::uint8_t> ids, std::uint16_t address,
                                                       std::uint16_t size) {
  send({kBroadcastId, Instruction::kSyncRead, sync_read_parameters(ids, address, size)},
       ids.size() * (kStatusOverhead + size));
  std::vector<std::optional<Answer>> result(ids.size());
  std::size_t missing = ids.size();
  while (missing > 0) {
    const std::optional<Packet> packet = next_answer();
    if (!packet) break;
    const auto at = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), packet->id) - ids.begin());
    if (at == ids.size() || result[at]) continue;
    Answer answer = to_answer(*packet);
    if (answer.data.size() != size && error_number(answer.error) == StatusError::kNone) continue;
    result[at] = std::move(answer);
    --missing;
  }
  answers_ += ids.size() - missing;
  missing_answers_ += missing;
  return result;
}

std::vector<std::optional<Answer>> ServoBus::fast_sync_read(std::span<const std::uint8_t> ids, std::uint16_t address,
                                                            std::uint16_t size) {
  // Of each servo: error, id, data, and the checksum of the packet up to there.
  const std::size_t block = 2U + size + 2U;
  send({kBroadcastId, Instruction::kFastSyncRead, sync_read_parameters(ids, address, size)},
       kStatusOverhead + ids.size() * block);
  std::vector<std::optional<Answer>> result(ids.size());
  while (const std::optional<Packet> packet = next_answer()) {
    // The checksum of the last block is that of the packet.
    if (packet->id != kBroadcastId || packet->parameters.size() + 2U != ids.size() * block) continue;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const std::string_view of_servo = std::string_view(packet->parameters).substr(i * block);
      if (static_cast<std::uint8_t>(of_servo[1]) != ids[i]) continue;
      result[i] = Answer{static_cast<std::uint8_t>(of_servo[0]), std::string(of_servo.substr(2, size))};
      ++answers_;
    }
    return result;
  }
  missing_answers_ += ids.size();
  return result;
}

void ServoBus::sync_write(std::uint16_t address, std::span<const SyncWriteEntry> entries) {
  if (!entries.empty()) line_.write(encode(sync_write_instruction(address, entries)));
}

}  // namespace glissade::bridges::dynamixel

#include "dynamixel/emulated_bus.h"

#include <algorithm>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/base/byte_order.h>

namespace glissade::bridges::dynamixel {
namespace {

std::chrono::nanoseconds return_delay(const EmulatedServo& servo) {
  return servo.get(kReturnDelayTime) * std::chrono::microseconds(2);
}

/// Address and size at the begin of many parameters.
struct TableRange {
  std::uint16_t address;
  std::uint16_t size;
};

std::optional<TableRange> range_in(std::string_view parameters) {
  if (parameters.size() < 4) return std::nullopt;
  return TableRange{base::number_at<std::uint16_t>(parameters, 0), base::number_at<std::uint16_t>(parameters, 2)};
}

}  // namespace

EmulatedBus::EmulatedBus(std::vector<EmulatedServo> servos, double baud_rate)
    : servos_(std::move(servos)), baud_rate_(baud_rate) {
  std::sort(servos_.begin(), servos_.end(), [](const auto& one, const auto& other) { return one.id() < other.id(); });
}

EmulatedServo* EmulatedBus::find(std::uint8_t id) {
  const auto found = std::find_if(servos_.begin(), servos_.end(), [id](const auto& one) { return one.id() == id; });
  return found == servos_.end() || !found->is_connected ? nullptr : &*found;
}

EmulatedServo& EmulatedBus::servo(std::uint8_t id) {
  const auto found = std::find_if(servos_.begin(), servos_.end(), [id](const auto& one) { return one.id() == id; });
  GLISSADE_ASSERT(found != servos_.end());
  return *found;
}

/// Step by step together, because the servos may turn the joints of one hand.
void EmulatedBus::advance(std::chrono::nanoseconds now) {
  constexpr std::chrono::milliseconds kStep{1};
  while (now_ < now) {
    now_ = std::min(now_ + kStep, now);
    for (EmulatedServo& one : servos_)
      one.advance(now_);
  }
}

void EmulatedBus::receive(std::string_view bytes, std::chrono::nanoseconds now) {
  advance(now);
  line_is_free_ = std::max(line_is_free_, now);
  decoder_.push(bytes);
  while (const std::optional<Packet> packet = decoder_.next()) {
    for (EmulatedServo& one : servos_) {
      if (one.is_connected) one.hear(now);
    }
    ++instructions_;
    execute(*packet);
  }
}

std::string EmulatedBus::send_until(std::chrono::nanoseconds now) {
  advance(now);
  std::string bytes;
  for (; !sent_.empty() && sent_.front().time <= now; sent_.pop_front())
    bytes += sent_.front().bytes;
  return bytes;
}

std::optional<std::chrono::nanoseconds> EmulatedBus::next_time() const {
  if (sent_.empty()) return std::nullopt;
  return sent_.front().time;
}

void EmulatedBus::send(const std::string& bytes, std::chrono::nanoseconds delay) {
  constexpr double kBitsPerByte = 10.0;
  const auto on_line = static_cast<std::int64_t>(static_cast<double>(bytes.size()) * kBitsPerByte / baud_rate_ * 1e9);
  line_is_free_ += delay + std::chrono::nanoseconds(on_line);
  sent_.push_back({line_is_free_, bytes});
}

void EmulatedBus::answer(const EmulatedServo& servo, StatusError error, const std::string& data) {
  std::string parameters(1, static_cast<char>(servo.error_byte(error)));
  send(encode({servo.id(), Instruction::kStatus, parameters + data}), return_delay(servo));
}

void EmulatedBus::execute(const Packet& instruction) {
  if (instruction.id != kBroadcastId) {
    if (EmulatedServo* const servo = find(instruction.id)) execute_for(*servo, instruction);
    return;
  }
  switch (instruction.instruction) {
    case Instruction::kPing:
      return ping_all();
    case Instruction::kSyncRead:
      return sync_read(instruction);
    case Instruction::kFastSyncRead:
      return fast_sync_read(instruction);
    case Instruction::kSyncWrite:
      return sync_write(instruction);
    default:
      return;
  }
}

void EmulatedBus::execute_for(EmulatedServo& servo, const Packet& instruction) {
  const std::string& parameters = instruction.parameters;
  switch (instruction.instruction) {
    case Instruction::kPing:
      return answer(servo, StatusError::kNone,
                    *servo.read(kModelNumber.address, kModelNumber.size) +
                        *servo.read(kFirmwareVersion.address, kFirmwareVersion.size));
    case Instruction::kRead: {
      const std::optional<TableRange> range = range_in(parameters);
      const auto data = range ? servo.read(range->address, range->size) : std::nullopt;
      return answer(servo, data ? StatusError::kNone : StatusError::kAccess, data.value_or(""));
    }
    case Instruction::kWrite:
      if (parameters.size() < 3) return answer(servo, StatusError::kDataLength, {});
      return answer(servo, servo.write(base::number_at<std::uint16_t>(parameters, 0), parameters.substr(2)), {});
    case Instruction::kReboot:
      answer(servo, StatusError::kNone, {});
      return servo.restart();
    case Instruction::kStatus:
      return;
    default:
      return answer(servo, StatusError::kInstruction, {});
  }
}

void EmulatedBus::ping_all() {
  for (EmulatedServo& one : servos_) {
    if (one.is_connected) execute_for(one, {one.id(), Instruction::kPing, {}});
  }
}

void EmulatedBus::sync_read(const Packet& instruction) {
  const std::optional<TableRange> range = range_in(instruction.parameters);
  if (!range) return;
  for (const char id : instruction.parameters.substr(4)) {
    EmulatedServo* const servo = find(static_cast<std::uint8_t>(id));
    if (servo == nullptr) return;
    const auto data = servo->read(range->address, range->size);
    answer(*servo, data ? StatusError::kNone : StatusError::kAccess, data.value_or(""));
  }
}

void EmulatedBus::fast_sync_read(const Packet& instruction) {
  const std::optional<TableRange> range = range_in(instruction.parameters);
  if (!range || instruction.parameters.size() == 4) return;
  // Each servo adds its block, and the checksum of the packet so far. The last checksum is that of the whole packet, so
  // the parts before it need the final length: encode the packet with placeholders first.
  const std::string ids = instruction.parameters.substr(4);
  const std::size_t block = 4U + range->size;
  std::string parameters;
  for (const char id : ids) {
    EmulatedServo* const servo = find(static_cast<std::uint8_t>(id));
    const auto data = servo != nullptr ? servo->read(range->address, range->size) : std::nullopt;
    if (!data || servo->get(kFirmwareVersion) < 46) return;
    parameters.push_back(static_cast<char>(servo->error_byte(StatusError::kNone)));
    parameters.push_back(id);
    parameters += *data + std::string(2, '\0');
  }
  parameters.resize(parameters.size() - 2);
  constexpr std::size_t kBeforeParameters = 8;
  for (std::size_t i = 1; i < ids.size(); ++i) {
    const std::size_t end = i * block - 2;
    const std::string so_far =
        encode({kBroadcastId, Instruction::kStatus, parameters}).substr(0, kBeforeParameters + end);
    std::string checksum;
    base::append_number(checksum, crc16(so_far));
    parameters.replace(end, 2, checksum);
  }
  send(encode({kBroadcastId, Instruction::kStatus, parameters}),
       return_delay(*find(static_cast<std::uint8_t>(ids[0]))));
}

void EmulatedBus::sync_write(const Packet& instruction) {
  const std::optional<TableRange> range = range_in(instruction.parameters);
  if (!range) return;
  const std::size_t entry = 1U + range->size;
  for (std::size_t at = 4; at + entry <= instruction.parameters.size(); at += entry) {
    EmulatedServo* const servo = find(static_cast<std::uint8_t>(instruction.parameters[at]));
    if (servo != nullptr)
      servo->write(range->address, std::string_view(instruction.parameters).substr(at + 1, range->size));
  }
}

}  // namespace glissade::bridges::dynamixel

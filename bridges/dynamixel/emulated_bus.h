#pragma once

/// A bus of emulated servos.

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamixel/emulated_servo.h"
#include "dynamixel/packet.h"
#include "emulation/emulated_device.h"

namespace glissade::bridges::dynamixel {

/// Answers as servos do: after their return delay, one after another, with the time of their bytes on the line. In a
/// sync read, a servo waits for the answer of the servo before it, so after a missing one all are silent.
class EmulatedBus final : public EmulatedDevice {
 public:
  EmulatedBus(std::vector<EmulatedServo> servos, double baud_rate);

  void receive(std::string_view bytes, std::chrono::nanoseconds now) override;
  std::string send_until(std::chrono::nanoseconds now) override;
  std::optional<std::chrono::nanoseconds> next_time() const override;

  /// The servo with this id, which must exist.
  EmulatedServo& servo(std::uint8_t id);

  /// Instructions received so far.
  std::uint64_t instructions() const noexcept { return instructions_; }

 private:
  struct Sent {
    std::chrono::nanoseconds time;
    std::string bytes;
  };

  EmulatedServo* find(std::uint8_t id);
  void advance(std::chrono::nanoseconds now);
  void execute(const Packet& instruction);
  void execute_for(EmulatedServo& servo, const Packet& instruction);
  void ping_all();
  void sync_read(const Packet& instruction);
  void fast_sync_read(const Packet& instruction);
  void sync_write(const Packet& instruction);
  void answer(const EmulatedServo& servo, StatusError error, const std::string& data);
  void send(const std::string& bytes, std::chrono::nanoseconds delay);

  std::vector<EmulatedServo> servos_;
  std::chrono::nanoseconds now_{0};
  double baud_rate_;
  PacketDecoder decoder_;
  std::deque<Sent> sent_;
  std::chrono::nanoseconds line_is_free_{0};
  std::uint64_t instructions_ = 0;
};

}  // namespace glissade::bridges::dynamixel

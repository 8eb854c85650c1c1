#pragma once

/// What a servo needs before it may hold the limits of a joint.

#include <cstdint>
#include <string>

#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/realtime/clock.h>

#include "dynamixel/joint_scale.h"
#include "dynamixel/registers.h"
#include "dynamixel/servo_bus.h"

namespace glissade::bridges::dynamixel {

/// Firmware from which servos know fast sync read.
inline constexpr int kFastReadFirmware = 46;

/// The acknowledged accesses to one servo. Each is tried three times. Then it throws WireError, with the servo, the
/// line and the reason.
class ServoAccess {
 public:
  ServoAccess(ServoBus& bus, std::uint8_t id, std::string line_name);

  PingAnswer ping();
  std::int64_t read(const Register& from);
  /// Bytes of the control table from `first` to the end of `last`.
  std::string read_table(const Register& first, const Register& last);
  void write(const Register& to, std::int64_t value);
  /// Writes only if the value differs: memory that keeps its value without power wears out.
  void ensure(const Register& at, std::int64_t value);
  void reboot();

  /// "Servo 3 on /dev/ttyUSB0".
  const std::string& name() const noexcept { return name_; }
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  std::string data_of(const std::optional<Answer>& answer, const std::string& what, int attempt) const;

  ServoBus& bus_;
  std::uint8_t id_;
  std::string name_;
};

/// Why the bridge cannot use the servo, as the end of a sentence that begins with its name: another model, old
/// firmware, a homing offset. Empty if it can. Throws WireError.
std::string trouble_of(ServoAccess& servo, const DynamixelHand& hand);

/// Refuses a servo with a trouble, turns the torque off, restarts a servo with a hardware error, and writes all
/// settings of the hand. Returns the present position. Throws WireError.
std::int64_t set_up(ServoAccess& servo, const DynamixelHand& hand, const JointScale& scale, realtime::Clock& clock);

/// Starts the bus watchdog, also one that has expired. The torque is off afterwards. Throws WireError.
void start_watchdog(ServoAccess& servo, const DynamixelHand& hand);

/// The count of the register Bus Watchdog.
std::int64_t watchdog_count(const DynamixelHand& hand) noexcept;

}  // namespace glissade::bridges::dynamixel

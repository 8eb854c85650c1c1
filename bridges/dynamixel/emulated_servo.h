#pragma once

/// A servo XL330 or XC330, emulated: its registers and its loop in operating mode 5.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "dynamixel/horn_load.h"
#include "dynamixel/packet.h"
#include "dynamixel/registers.h"
#include "dynamixel/status.h"

namespace glissade::bridges::dynamixel {

/// The loop runs once a millisecond: current = P gain · 1 mA / 128 · position error in counts, at most the goal current
/// and the current limit. There is neither D nor I gain, inertia of the motor, nor play of the gear. When the torque
/// turns on, the goal is the present position. When the bus watchdog expires, the servo holds its place: the goal is
/// the present position, and goals are read-only. The data sheet does not say more, so a real servo may differ.
class EmulatedServo {
 public:
  /// Starts as from the factory, with the torque off.
  EmulatedServo(std::uint8_t id, const ServoModel& model, std::shared_ptr<HornLoad> load);

  std::uint8_t id() const noexcept { return id_; }

  /// Lets time pass in steps of a millisecond.
  void advance(std::chrono::nanoseconds now);
  /// An instruction has arrived on the bus, for this servo or another.
  void hear(std::chrono::nanoseconds now) noexcept { heard_ = now; }

  /// Instructions to this servo, as answers would report them.
  StatusError write(std::uint16_t address, std::string_view data);
  std::optional<std::string> read(std::uint16_t address, std::uint16_t size) const;
  void restart();

  std::int64_t get(const Register& of) const;
  /// Sets a register without any check, for example a firmware version.
  void set(const Register& to, std::int64_t value);

  /// A hardware error (bits of status.h): the torque turns off and stays off until a restart.
  void break_down(std::uint8_t hardware_error) noexcept;
  /// The error byte of the answers.
  std::uint8_t error_byte(StatusError number) const noexcept;

  double torque() const noexcept { return torque_; }  ///< at the horn, Nm
  HornLoad& load() noexcept { return *load_; }

  bool is_connected = true;       ///< without a connection, nothing arrives and no answer leaves
  bool survives_restart = false;  ///< a hardware error stays after a restart

 private:
  StatusError check(const Register& to, std::int64_t value) const;
  void apply(const Register& to, std::int64_t value);
  void set_ram_defaults();
  void watch_bus();
  void step();
  void measure();
  std::string_view bytes_of(const Register& of) const;

  std::uint8_t id_;
  ServoModel model_;
  std::shared_ptr<HornLoad> load_;
  std::string table_;
  std::chrono::nanoseconds now_{0};
  std::chrono::nanoseconds heard_{0};
  double torque_ = 0.0;
};

}  // namespace glissade::bridges::dynamixel

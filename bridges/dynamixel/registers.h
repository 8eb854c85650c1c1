#pragma once

/// The registers (control table) of the servos XL330 and XC330, and the properties of their models.
/// Source: emanual.robotis.com/docs/en/dxl/x/xl330-m288 and its neighbors.

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::bridges::dynamixel {

/// Where a register keeps its value.
enum class Memory : std::uint8_t {
  kEeprom,    ///< stays without power; locked while the torque is on
  kRam,       ///< set to a default at each start
  kReadOnly,  ///< a measurement or a property
};

struct Register {
  std::string_view name;
  std::uint16_t address;
  std::uint8_t size;  ///< bytes, little-endian
  bool is_signed;
  Memory memory;
  double unit;                 ///< SI units in a count
  std::string_view unit_name;  ///< empty for a pure number
};

/// Counts of the position sensor in a turn.
inline constexpr double kCountsPerTurn = 4096.0;
inline constexpr double kPositionUnit_rad = 2.0 * std::numbers::pi / kCountsPerTurn;
/// 0.229 turns a minute.
inline constexpr double kVelocityUnit_rad_per_s = 0.229 * 2.0 * std::numbers::pi / 60.0;
inline constexpr double kCurrentUnit_A = 1e-3;

inline constexpr Register kModelNumber{"Model Number", 0, 2, false, Memory::kReadOnly, 1.0, ""};
inline constexpr Register kFirmwareVersion{"Firmware Version", 6, 1, false, Memory::kReadOnly, 1.0, ""};
inline constexpr Register kServoId{"ID", 7, 1, false, Memory::kEeprom, 1.0, ""};
inline constexpr Register kBaudRate{"Baud Rate", 8, 1, false, Memory::kEeprom, 1.0, ""};
inline constexpr Register kReturnDelayTime{"Return Delay Time", 9, 1, false, Memory::kEeprom, 2e-6, "s"};
inline constexpr Register kDriveMode{"Drive Mode", 10, 1, false, Memory::kEeprom, 1.0, ""};
inline constexpr Register kOperatingMode{"Operating Mode", 11, 1, false, Memory::kEeprom, 1.0, ""};
inline constexpr Register kHomingOffset{"Homing Offset", 20, 4, true, Memory::kEeprom, kPositionUnit_rad, "rad"};
inline constexpr Register kTemperatureLimit{"Temperature Limit", 31, 1, false, Memory::kEeprom, 1.0, "°C"};
inline constexpr Register kMaxVoltageLimit{"Max Voltage Limit", 32, 2, false, Memory::kEeprom, 0.1, "V"};
inline constexpr Register kMinVoltageLimit{"Min Voltage Limit", 34, 2, false, Memory::kEeprom, 0.1, "V"};
inline constexpr Register kPwmLimit{"PWM Limit", 36, 2, false, Memory::kEeprom, 0.00113, "of the supply"};
inline constexpr Register kCurrentLimit{"Current Limit", 38, 2, false, Memory::kEeprom, kCurrentUnit_A, "A"};
inline constexpr Register kVelocityLimit{"Velocity Limit",        44,     4, false, Memory::kEeprom,
                                         kVelocityUnit_rad_per_s, "rad/s"};
inline constexpr Register kShutdown{"Shutdown", 63, 1, false, Memory::kEeprom, 1.0, ""};
inline constexpr Register kTorqueEnable{"Torque Enable", 64, 1, false, Memory::kRam, 1.0, ""};
inline constexpr Register kLed{"LED", 65, 1, false, Memory::kRam, 1.0, ""};
inline constexpr Register kStatusReturnLevel{"Status Return Level", 68, 1, false, Memory::kRam, 1.0, ""};
inline constexpr Register kHardwareErrorStatus{"Hardware Error Status", 70, 1, false, Memory::kReadOnly, 1.0, ""};
inline constexpr Register kPositionDGain{"Position D Gain", 80, 2, false, Memory::kRam, 1.0 / 16.0, ""};
inline constexpr Register kPositionIGain{"Position I Gain", 82, 2, false, Memory::kRam, 1.0 / 65536.0, ""};
inline constexpr Register kPositionPGain{"Position P Gain", 84, 2, false, Memory::kRam, 1.0 / 128.0, ""};
inline constexpr Register kBusWatchdog{"Bus Watchdog", 98, 1, true, Memory::kRam, 0.02, "s"};
inline constexpr Register kGoalPwm{"Goal PWM", 100, 2, true, Memory::kRam, 0.00113, "of the supply"};
inline constexpr Register kGoalCurrent{"Goal Current", 102, 2, true, Memory::kRam, kCurrentUnit_A, "A"};
inline constexpr Register kGoalVelocity{"Goal Velocity", 104, 4, true, Memory::kRam, kVelocityUnit_rad_per_s, "rad/s"};
inline constexpr Register kGoalPosition{"Goal Position", 116, 4, true, Memory::kRam, kPositionUnit_rad, "rad"};
inline constexpr Register kRealtimeTick{"Realtime Tick", 120, 2, false, Memory::kReadOnly, 1e-3, "s"};
inline constexpr Register kPresentCurrent{"Present Current", 126, 2, true, Memory::kReadOnly, kCurrentUnit_A, "A"};
inline constexpr Register kPresentVelocity{"Present Velocity",      128,    4, true, Memory::kReadOnly,
                                           kVelocityUnit_rad_per_s, "rad/s"};
inline constexpr Register kPresentPosition{"Present Position", 132,  4, true, Memory::kReadOnly,
                                           kPositionUnit_rad,  "rad"};
inline constexpr Register kPresentInputVoltage{"Present Input Voltage", 144, 2, false, Memory::kReadOnly, 0.1, "V"};
inline constexpr Register kPresentTemperature{"Present Temperature", 146, 1, false, Memory::kReadOnly, 1.0, "°C"};

/// All registers above, by ascending addresses.
inline constexpr std::array kRegisters{kModelNumber,
                                       kFirmwareVersion,
                                       kServoId,
                                       kBaudRate,
                                       kReturnDelayTime,
                                       kDriveMode,
                                       kOperatingMode,
                                       kHomingOffset,
                                       kTemperatureLimit,
                                       kMaxVoltageLimit,
                                       kMinVoltageLimit,
                                       kPwmLimit,
                                       kCurrentLimit,
                                       kVelocityLimit,
                                       kShutdown,
                                       kTorqueEnable,
                                       kLed,
                                       kStatusReturnLevel,
                                       kHardwareErrorStatus,
                                       kPositionDGain,
                                       kPositionIGain,
                                       kPositionPGain,
                                       kBusWatchdog,
                                       kGoalPwm,
                                       kGoalCurrent,
                                       kGoalVelocity,
                                       kGoalPosition,
                                       kRealtimeTick,
                                       kPresentCurrent,
                                       kPresentVelocity,
                                       kPresentPosition,
                                       kPresentInputVoltage,
                                       kPresentTemperature};

/// Bytes of the control table.
inline constexpr std::size_t kTableSize = 228;

/// Operating mode: position, with a cap of current.
inline constexpr std::int64_t kCurrentBasedPosition = 5;
/// Bus watchdog: it has expired.
inline constexpr std::int64_t kWatchdogExpired = -1;

/// The value in `bytes`, which must have the register's size.
std::int64_t decode_register(const Register& of, std::string_view bytes);
/// The bytes of a value, clamped to the register's range of numbers.
std::string encode_register(const Register& of, std::int64_t value);

/// The count nearest to a value in SI units.
std::int64_t to_counts(const Register& of, double value) noexcept;

/// What the data sheet says about a model, at its recommended voltage.
struct ServoModel {
  std::string_view name;
  std::uint16_t number;  ///< register Model Number
  double stall_torque_Nm;
  double stall_current_A;
  double no_load_speed_rad_per_s;
  double gear_ratio;
  double max_current_A;  ///< largest value of the register Current Limit
  double backlash_rad;
};

/// The model with this name, such as "XL330-M288", or with this number.
std::optional<ServoModel> find_model(std::string_view name);
std::optional<ServoModel> find_model(std::uint16_t number);
/// Names of all models, joined by commas.
std::string model_names();

/// Nm/A at the horn.
constexpr double torque_per_current(const ServoModel& model) noexcept {
  return model.stall_torque_Nm / model.stall_current_A;
}

}  // namespace glissade::bridges::dynamixel

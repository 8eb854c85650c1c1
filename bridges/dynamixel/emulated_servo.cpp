#include "dynamixel/emulated_servo.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::bridges::dynamixel {
namespace {

constexpr std::chrono::milliseconds kStep{1};
constexpr double kStep_s = 1e-3;
constexpr std::int64_t kPositionControl = 3;
constexpr std::int64_t kFactoryPGain = 400;
constexpr std::int64_t kFirmware = 46;
constexpr double kCurrentPerGain_A = 1e-3 / 128.0;
constexpr std::uint16_t kFirstGoal = kGoalPwm.address;
constexpr std::uint16_t kLastGoal = kGoalPosition.address;

const Register* register_at(std::uint16_t address) {
  const auto* const found = std::find_if(kRegisters.begin(), kRegisters.end(),
                                         [address](const Register& one) { return one.address == address; });
  return found == kRegisters.end() ? nullptr : found;
}

bool is_goal(const Register& one) {
  return one.address >= kFirstGoal && one.address <= kLastGoal;
}

}  // namespace

EmulatedServo::EmulatedServo(std::uint8_t id, const ServoModel& model, std::shared_ptr<HornLoad> load)
    : id_(id), model_(model), load_(std::move(load)), table_(kTableSize, '\0') {
  set(kModelNumber, model_.number);
  set(kFirmwareVersion, kFirmware);
  set(kServoId, id_);
  set(kReturnDelayTime, 250);
  set(kOperatingMode, kPositionControl);
  set(kPwmLimit, 885);
  set(kCurrentLimit, to_counts(kCurrentLimit, model_.max_current_A));
  set_ram_defaults();
}

void EmulatedServo::set_ram_defaults() {
  std::fill(table_.begin() + kTorqueEnable.address, table_.end(), '\0');
  set(kStatusReturnLevel, 2);
  set(kPresentInputVoltage, to_counts(kPresentInputVoltage, 5.0));
  set(kPresentTemperature, 30);
  set(kPositionPGain, kFactoryPGain);
  set(kGoalPwm, get(kPwmLimit));
  set(kGoalCurrent, get(kCurrentLimit));
  measure();
  set(kGoalPosition, get(kPresentPosition));
}

std::string_view EmulatedServo::bytes_of(const Register& of) const {
  return std::string_view(table_).substr(of.address, of.size);
}

std::int64_t EmulatedServo::get(const Register& of) const {
  return decode_register(of, bytes_of(of));
}

void EmulatedServo::set(const Register& to, std::int64_t value) {
  table_.replace(to.address, to.size, encode_register(to, value));
}

std::uint8_t EmulatedServo::error_byte(StatusError number) const noexcept {
  const auto bits = static_cast<std::uint8_t>(number);
  return table_[kHardwareErrorStatus.address] != 0 ? static_cast<std::uint8_t>(bits | kAlert) : bits;
}

void EmulatedServo::break_down(std::uint8_t hardware_error) noexcept {
  table_[kHardwareErrorStatus.address] = static_cast<char>(hardware_error);
  if (hardware_error != 0) table_[kTorqueEnable.address] = 0;
}

void EmulatedServo::restart() {
  const char error = table_[kHardwareErrorStatus.address];
  set_ram_defaults();
  if (survives_restart) table_[kHardwareErrorStatus.address] = error;
}

std::optional<std::string> EmulatedServo::read(std::uint16_t address, std::uint16_t size) const {
  if (address > table_.size() || size > table_.size() - address) return std::nullopt;
  return table_.substr(address, size);
}

StatusError EmulatedServo::check(const Register& to, std::int64_t value) const {
  const bool has_torque = get(kTorqueEnable) != 0;
  if (to.memory == Memory::kReadOnly || (to.memory == Memory::kEeprom && has_torque)) return StatusError::kAccess;
  if (is_goal(to) && get(kBusWatchdog) == kWatchdogExpired) return StatusError::kDataRange;
  const auto is_within = [value](std::int64_t least, std::int64_t most) { return value >= least && value <= most; };
  if (to.address == kTorqueEnable.address && !is_within(0, 1)) return StatusError::kDataRange;
  if (to.address == kBusWatchdog.address && !is_within(0, 127)) return StatusError::kDataRange;
  if (to.address == kReturnDelayTime.address && !is_within(0, 254)) return StatusError::kDataRange;
  if (to.address == kGoalCurrent.address && !is_within(-get(kCurrentLimit), get(kCurrentLimit)))
    return StatusError::kDataLimit;
  if (to.address == kGoalPosition.address && !is_within(-1048575, 1048575)) return StatusError::kDataRange;
  return StatusError::kNone;
}

void EmulatedServo::apply(const Register& to, std::int64_t value) {
  const bool turns_on = to.address == kTorqueEnable.address && value == 1 && get(kTorqueEnable) == 0;
  if (turns_on && get(kHardwareErrorStatus) != 0) return;
  set(to, value);
  if (turns_on) {
    set(kGoalPosition, get(kPresentPosition));
    heard_ = now_;
  }
  if (to.address == kOperatingMode.address) {
    set(kGoalCurrent, get(kCurrentLimit));
    set(kPositionPGain, kFactoryPGain);
  }
}

StatusError EmulatedServo::write(std::uint16_t address, std::string_view data) {
  while (!data.empty()) {
    const Register* const to = register_at(address);
    if (to == nullptr) return StatusError::kAccess;
    if (data.size() < to->size) return StatusError::kDataLength;
    const std::int64_t value = decode_register(*to, data.substr(0, to->size));
    if (const StatusError error = check(*to, value); error != StatusError::kNone) return error;
    apply(*to, value);
    data.remove_prefix(to->size);
    address = static_cast<std::uint16_t>(address + to->size);
  }
  return StatusError::kNone;
}

void EmulatedServo::advance(std::chrono::nanoseconds now) {
  for (; now_ + kStep <= now; now_ += kStep) {
    watch_bus();
    step();
  }
}

void EmulatedServo::watch_bus() {
  const std::int64_t count = get(kBusWatchdog);
  if (count <= 0 || get(kTorqueEnable) == 0) return;
  if (now_ - heard_ <= count * std::chrono::milliseconds(20)) return;
  set(kBusWatchdog, kWatchdogExpired);
  set(kGoalPosition, get(kPresentPosition));
}

void EmulatedServo::step() {
  double current_A = 0.0;
  if (get(kTorqueEnable) != 0 && get(kOperatingMode) == kCurrentBasedPosition) {
    const auto error = static_cast<double>(get(kGoalPosition) - get(kPresentPosition));
    const double cap_A =
        kCurrentUnit_A * static_cast<double>(std::min(std::abs(get(kGoalCurrent)), get(kCurrentLimit)));
    current_A = std::clamp(kCurrentPerGain_A * static_cast<double>(get(kPositionPGain)) * error, -cap_A, cap_A);
  }
  torque_ = current_A * torque_per_current(model_);
  load_->step(torque_, kStep_s);
  set(kPresentCurrent, to_counts(kPresentCurrent, current_A));
  measure();
}

void EmulatedServo::measure() {
  set(kPresentVelocity, to_counts(kPresentVelocity, load_->rate()));
  set(kPresentPosition, to_counts(kPresentPosition, load_->angle()));
}

}  // namespace glissade::bridges::dynamixel

#include "dynamixel/servo_setup.h"

#include <algorithm>
#include <utility>

namespace glissade::bridges::dynamixel {
namespace {

constexpr int kAttempts = 3;
constexpr std::chrono::milliseconds kRestartTime{500};

/// A servo with a hardware error turns its torque off, and only a restart lets it turn on again.
void clear_hardware_error(ServoAccess& servo, realtime::Clock& clock) {
  if (servo.read(kHardwareErrorStatus) == 0) return;
  servo.reboot();
  clock.sleep_until(clock.now() + kRestartTime);
  servo.ping();
  const std::int64_t error = servo.read(kHardwareErrorStatus);
  if (error != 0) servo.fail("has a hardware error: " + hardware_error_text(static_cast<std::uint8_t>(error)));
}

}  // namespace

ServoAccess::ServoAccess(ServoBus& bus, std::uint8_t id, std::string line_name)
    : bus_(bus), id_(id), name_("Servo " + std::to_string(id) + " on " + std::move(line_name)) {}

void ServoAccess::fail(const std::string& reason) const {
  throw WireError(name_ + " " + reason + ".");
}

PingAnswer ServoAccess::ping() {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (const std::optional<PingAnswer> answer = bus_.ping(id_)) return *answer;
  }
  fail("does not answer; check its supply and cable, its id and the baud rate");
}

/// The data of an answer without an error. Throws at the last attempt if there is none, else returns nothing.
std::string ServoAccess::data_of(const std::optional<Answer>& answer, const std::string& what, int attempt) const {
  const bool is_good = answer && error_number(answer->error) == StatusError::kNone;
  if (is_good) return answer->data;
  if (attempt + 1 == kAttempts)
    fail(answer ? "refused to " + what + ": " + to_text(error_number(answer->error)) : "did not answer to " + what);
  return {};
}

std::string ServoAccess::read_table(const Register& first, const Register& last) {
  const auto size = static_cast<std::uint16_t>(last.address + last.size - first.address);
  for (int attempt = 0;; ++attempt) {
    std::string data = data_of(bus_.read(id_, first.address, size), "read " + std::string(first.name), attempt);
    if (!data.empty()) return data;
  }
}

std::int64_t ServoAccess::read(const Register& from) {
  return decode_register(from, read_table(from, from));
}

void ServoAccess::write(const Register& to, std::int64_t value) {
  const std::string what = "write " + std::to_string(value) + " to " + std::string(to.name);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::optional<Answer> answer = bus_.write(id_, to.address, encode_register(to, value));
    data_of(answer, what, attempt);
    if (answer && error_number(answer->error) == StatusError::kNone) return;
  }
}

void ServoAccess::ensure(const Register& at, std::int64_t value) {
  if (read(at) != value) write(at, value);
}

void ServoAccess::reboot() {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (bus_.reboot(id_)) return;
  }
  fail("did not answer to a restart");
}

std::int64_t watchdog_count(const DynamixelHand& hand) noexcept {
  return std::clamp<std::int64_t>(to_counts(kBusWatchdog, std::chrono::duration<double>(hand.watchdog).count()), 1,
                                  127);
}

void start_watchdog(ServoAccess& servo, const DynamixelHand& hand) {
  servo.write(kTorqueEnable, 0);
  servo.write(kBusWatchdog, 0);
  servo.write(kBusWatchdog, watchdog_count(hand));
}

std::string trouble_of(ServoAccess& servo, const DynamixelHand& hand) {
  const PingAnswer identity = servo.ping();
  if (identity.model != find_model(hand.model)->number) {
    const std::optional<ServoModel> found = find_model(identity.model);
    return "is " +
           (found ? "an " + std::string(found->name) : "of the unknown model " + std::to_string(identity.model)) +
           ", but the configuration says " + hand.model;
  }
  if (hand.has_fast_read && identity.firmware < kFastReadFirmware) {
    return "has firmware " + std::to_string(identity.firmware) + ", but fast sync read needs " +
           std::to_string(kFastReadFirmware) + "; update it, or turn fast reading off";
  }
  // An offset moves the goal when the bus watchdog of an old firmware expires.
  if (servo.read(kHomingOffset) == 0) return {};
  return "has a homing offset; set the register Homing Offset to 0, and use the zero angle of the configuration";
}

std::int64_t set_up(ServoAccess& servo, const DynamixelHand& hand, const JointScale& scale, realtime::Clock& clock) {
  if (const std::string trouble = trouble_of(servo, hand); !trouble.empty()) servo.fail(trouble);
  servo.write(kTorqueEnable, 0);
  servo.write(kBusWatchdog, 0);  // else an expired one keeps the goals read-only
  clear_hardware_error(servo, clock);
  servo.ensure(kReturnDelayTime, 0);
  servo.ensure(kDriveMode, 0);
  servo.ensure(kOperatingMode, kCurrentBasedPosition);
  servo.ensure(kCurrentLimit, scale.max_current());
  servo.write(kGoalCurrent, 0);
  servo.write(kPositionDGain, hand.position_d_gain);
  servo.write(kPositionIGain, 0);
  servo.write(kPositionPGain, 0);
  start_watchdog(servo, hand);
  return servo.read(kPresentPosition);
}

}  // namespace glissade::bridges::dynamixel

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <glissade/devices/safety_envelope.h>

namespace glissade::devices {

namespace {

using std::chrono::nanoseconds;

std::string age_text(nanoseconds age) {
  if (age > std::chrono::seconds(10)) return "more than 10 s old";
  if (age >= std::chrono::milliseconds(10)) return std::to_string(age / std::chrono::milliseconds(1)) + " ms old";
  const std::int64_t tenths = age / std::chrono::microseconds(100);
  return std::to_string(tenths / 10) + "." + std::to_string(std::abs(tenths % 10)) + " ms old";
}

}  // namespace

std::string to_text(const LimitReasons& reasons, nanoseconds age) {
  const std::string old = age_text(age);
  if (reasons.is_stopped) return "no force: it was stopped for good";
  if (reasons.is_disabled) return "no force: the wearer does not hold the enable switch";
  if (reasons.is_refused) return "no force: the glove obeys another server";
  if (reasons.not_finite) return "no force: a number of the glove's state or of the command is not finite";
  if (reasons.is_implausible) return "no force: the glove's pose jumps or freezes or leaves the workspace";
  if (reasons.is_state_old) return "no force: the glove's state is " + old;
  if (reasons.is_command_old && age < nanoseconds(0)) return "no force: the command answers a state that never was";
  if (reasons.is_command_old) return "no force: the command answers a state that is " + old;
  if (reasons.is_returning) return "reduced force: it returns softly";
  if (reasons.mean_limited) return "reduced force: its mean is near the device's limit";
  if (reasons.energy_limited) return "reduced force: it has given back all energy that the hand put in";
  if (reasons.power_limited) return "reduced force: its power is at the device's limit";
  if (reasons.force_limited || reasons.torque_limited || reasons.joints_limited) {
    return "reduced force: it is at the device's limit";
  }
  if (reasons.rate_limited) return "reduced force: it changes as fast as the device's limit allows";
  return {};
}

std::string to_text(const SafeCommand& command) {
  return to_text(command.reasons(), command.reasons().is_state_old ? command.state_age() : command.age());
}

}  // namespace glissade::devices

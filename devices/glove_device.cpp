#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/devices/glove_device.h>

#include "descriptor/bad_field.h"

namespace glissade::devices {
namespace {

/// The lag (seconds) of a loop in the device: half a period and its delay.
double lag_of_own_loop(const DeviceDescriptor& descriptor, double rate, std::chrono::nanoseconds delay) noexcept {
  return 0.5 / (rate > 0.0 ? rate : descriptor.update_rate) + std::chrono::duration<double>(delay).count();
}

}  // namespace

std::int32_t to_bits(const LimitReasons& reasons) noexcept {
  std::int32_t bits = 0;
  for (std::size_t i = 0; i < kLimitReasons.size(); ++i)
    bits |= reasons.*kLimitReasons[i].flag ? std::int32_t{1} << i : 0;
  return bits;
}

LimitReasons limit_reasons_from_bits(std::int32_t bits) noexcept {
  LimitReasons reasons;
  for (std::size_t i = 0; i < kLimitReasons.size(); ++i)
    reasons.*kLimitReasons[i].flag = (bits >> i & 1) != 0;
  return reasons;
}

void validate(const DeviceDescriptor& descriptor) {
  const std::optional<BadField> bad = first_bad_field(descriptor);
  if (!bad) return;
  throw std::invalid_argument("Device '" + descriptor.name + "': " + std::string(bad->name) + " " +
                              std::string(bad->rule) + ".");
}

std::optional<BadField> first_bad_field(const DeviceDescriptor& descriptor) noexcept {
  const auto seconds = [](std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); };
  const std::pair<std::string_view, double> limits[] = {
      {"max_force", descriptor.max_force},
      {"max_torque", descriptor.max_torque},
      {"max_stiffness", descriptor.max_stiffness},
      {"max_rotational_stiffness", descriptor.max_rotational_stiffness},
      {"max_damping", descriptor.max_damping},
      {"max_joint_torque", descriptor.max_joint_torque},
      {"damping", descriptor.damping},
      {"rotational_damping", descriptor.rotational_damping},
      {"joint_damping", descriptor.joint_damping},
      {"friction", descriptor.friction},
      {"joint_friction", descriptor.joint_friction},
      {"resolution", descriptor.resolution},
      {"joint_resolution", descriptor.joint_resolution},
      {"max_force_rate", descriptor.max_force_rate},
      {"max_torque_rate", descriptor.max_torque_rate},
      {"max_joint_torque_rate", descriptor.max_joint_torque_rate},
      {"max_power", descriptor.max_power},
      {"max_mean_force", descriptor.max_mean_force},
      {"max_speed", descriptor.max_speed},
      {"max_turn_rate", descriptor.max_turn_rate},
      {"workspace_radius", descriptor.workspace_radius},
      {"limit_rate", descriptor.limit_rate},
      {"max_limit_stiffness", descriptor.max_limit_stiffness},
      {"tool_rate", descriptor.tool_rate}};
  constexpr double kGreatest = 1e9;  // no device has more, and products of several such numbers are finite
  for (const auto& [field, value] : limits) {
    if (!(value >= 0.0 && value <= kGreatest)) return BadField{field, "must lie between 0 and 1e9", value};
  }
  // A sender that leaves these fields at zero would never feel a force.
  if (descriptor.max_speed == 0.0) return BadField{"max_speed", "must be greater than 0", 0.0};
  if (descriptor.max_turn_rate == 0.0) return BadField{"max_turn_rate", "must be greater than 0", 0.0};
  if (descriptor.workspace_radius == 0.0) return BadField{"workspace_radius", "must be greater than 0", 0.0};
  constexpr double kFastest_Hz = 1e5;
  if (!(descriptor.update_rate >= 1.0 && descriptor.update_rate <= kFastest_Hz))
    return BadField{"update_rate", "must lie between 1 and 100000 Hz", descriptor.update_rate};
  if (descriptor.frozen < std::chrono::nanoseconds(0))
    return BadField{"frozen", "must not be negative", seconds(descriptor.frozen)};
  if (descriptor.delay < std::chrono::nanoseconds(0))
    return BadField{"delay", "must not be negative", seconds(descriptor.delay)};
  if (descriptor.delay > std::chrono::seconds(1))
    return BadField{"delay", "must not be longer than a second", seconds(descriptor.delay)};
  if (descriptor.limit_delay < std::chrono::nanoseconds(0) || descriptor.limit_delay > std::chrono::seconds(1))
    return BadField{"limit_delay", "must lie between 0 and 1 s", seconds(descriptor.limit_delay)};
  if (descriptor.tool_delay < std::chrono::nanoseconds(0) || descriptor.tool_delay > std::chrono::seconds(1))
    return BadField{"tool_delay", "must lie between 0 and 1 s", seconds(descriptor.tool_delay)};
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    const double lower = descriptor.joint_lower[i];
    const double upper = descriptor.joint_upper[i];
    const bool is_absent = lower == 0.0 && upper == 0.0;
    if (!(std::abs(lower) <= kGreatest && std::abs(upper) <= kGreatest) || (lower >= upper && !is_absent)) {
      return BadField{hands::kJointNames[i], "needs a finite lower limit below a finite upper limit", lower};
    }
  }
  return std::nullopt;
}

double lag_of(const DeviceDescriptor& descriptor, std::chrono::nanoseconds period,
              std::chrono::nanoseconds link_delay) noexcept {
  const double period_s = std::max(std::chrono::duration<double>(period).count(), 1.0 / descriptor.update_rate);
  return 0.5 * period_s + std::chrono::duration<double>(descriptor.delay + link_delay).count();
}

double tool_lag(const DeviceDescriptor& descriptor, std::chrono::nanoseconds period,
                std::chrono::nanoseconds link_delay) noexcept {
  if (descriptor.tool_command == ToolCommand::kWrench) return lag_of(descriptor, period, link_delay);
  return lag_of_own_loop(descriptor, descriptor.tool_rate, descriptor.tool_delay);
}

double passive_limit(double told, double greatest, double own_lag, double lag) noexcept {
  return told > 0.0 ? told / lag : greatest * (own_lag / lag);
}

double passive_limit_stiffness(const DeviceDescriptor& descriptor) noexcept {
  if (descriptor.finger_command == FingerCommand::kTorque) return 0.0;
  const double lag = lag_of_own_loop(descriptor, descriptor.limit_rate, descriptor.limit_delay);
  double stiffness = descriptor.max_limit_stiffness;
  if (descriptor.finger_command == FingerCommand::kBrake) return stiffness;
  // A finger at this rate loses to dry friction as much as to so much damping.
  constexpr double kHeld_rad_per_s = 0.5;
  const double damping = descriptor.joint_damping + descriptor.joint_friction / kHeld_rad_per_s;
  if (descriptor.joint_damping > 0.0) stiffness = std::min(stiffness, damping / lag);
  const bool has_steps = descriptor.joint_friction > 0.0 && descriptor.joint_resolution > 0.0;
  if (has_steps) stiffness = std::min(stiffness, 2.0 * descriptor.joint_friction / descriptor.joint_resolution);
  return stiffness;
}

double passive_limit_damping(const DeviceDescriptor& descriptor, double stiffness) noexcept {
  const double lag = lag_of_own_loop(descriptor, descriptor.limit_rate, descriptor.limit_delay);
  return std::max(0.0, descriptor.joint_damping - stiffness * lag);
}

double joint_torque_rate(const DeviceDescriptor& descriptor) noexcept {
  constexpr double kPeriods = 2.0;  // the spring of a finger that taps at 6 rad/s rises hardly faster
  if (descriptor.max_joint_torque_rate > 0.0) return descriptor.max_joint_torque_rate;
  return descriptor.max_joint_torque * descriptor.update_rate / kPeriods;
}

}  // namespace glissade::devices

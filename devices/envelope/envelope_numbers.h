#pragma once

/// What the parts of the safety envelope share: times, and which numbers count as finite.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include <glissade/devices/glove_device.h>

#include "envelope/envelope_settings.h"

namespace glissade::devices {

inline double in_seconds(std::chrono::nanoseconds time) noexcept {
  return std::chrono::duration<double>(time).count();
}

/// So long a device holds limits and half-spaces without a new command.
inline std::chrono::nanoseconds expiry_of_limits(double period_s) noexcept {
  const std::chrono::duration<double> periods(kEnvelope.limits_last_periods * period_s);
  return std::max<std::chrono::nanoseconds>(kEnvelope.exerted_without_command,
                                            std::chrono::duration_cast<std::chrono::nanoseconds>(periods));
}

inline bool all_finite(const hands::JointValues& values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// Sums of times within these bounds cannot overflow.
inline bool is_finite(std::chrono::nanoseconds time) noexcept {
  constexpr std::chrono::nanoseconds kGreatest(std::int64_t{1} << 61);
  return -kGreatest < time && time < kGreatest;
}

inline bool is_finite(const JointLimits& limits) noexcept {
  return is_finite(limits.expiry) &&
         std::all_of(limits.joints.begin(), limits.joints.end(), [](const JointLimit& joint) {
           return std::isfinite(joint.lower) && std::isfinite(joint.upper) && std::isfinite(joint.stiffness) &&
                  std::isfinite(joint.damping) && std::isfinite(joint.max_torque);
         });
}

/// Half-spaces without rows are none, whatever the rest says.
inline bool is_finite(const HalfSpaces& half_spaces) noexcept {
  if (half_spaces.count == 0) return true;
  return half_spaces.X_WB.matrix().allFinite() && half_spaces.p_HR.allFinite() &&
         std::isfinite(half_spaces.stiffness) && std::isfinite(half_spaces.rotational_stiffness) &&
         std::isfinite(half_spaces.damping) && std::isfinite(half_spaces.max_force) &&
         std::isfinite(half_spaces.max_torque) &&
         std::all_of(half_spaces.rows.begin(), half_spaces.rows.end(), [](const HalfSpace& row) {
           return row.n_W.allFinite() && row.r_W.allFinite() && std::isfinite(row.bound);
         });
}

inline bool is_finite(const GloveCommand& command) noexcept {
  return is_finite(command.joint_limits) && is_finite(command.half_spaces) && std::isfinite(command.supply) &&
         is_finite(command.state_time) && command.f_H_W.allFinite() && command.t_H_W.allFinite() &&
         all_finite(command.joint_torques);
}

inline bool is_finite(const GloveState& state) noexcept {
  return is_finite(state.time) && state.X_WH.matrix().allFinite() && state.v_WH.allFinite() && state.w_WH.allFinite() &&
         all_finite(state.joint_angles);
}

}  // namespace glissade::devices

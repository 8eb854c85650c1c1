#pragma once

/// What the parts of the safety envelope share: which numbers count as finite.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include <glissade/devices/glove_device.h>

namespace glissade::devices {

inline double in_seconds(std::chrono::nanoseconds time) noexcept {
  return std::chrono::duration<double>(time).count();
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

inline bool is_finite(const GloveCommand& command) noexcept {
  return is_finite(command.joint_limits) && std::isfinite(command.supply) && is_finite(command.state_time) &&
         command.f_H_W.allFinite() && command.t_H_W.allFinite() && all_finite(command.joint_torques);
}

inline bool is_finite(const GloveState& state) noexcept {
  return is_finite(state.time) && state.X_WH.matrix().allFinite() && state.v_WH.allFinite() && state.w_WH.allFinite() &&
         all_finite(state.joint_angles);
}

}  // namespace glissade::devices

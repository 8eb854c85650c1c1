#pragma once

/// Limits of finger joints and half-spaces of the hand root in messages.

#include <glissade/devices/glove_device.h>
#include <glissade/lcmtypes/half_spaces_t.hpp>
#include <glissade/lcmtypes/joint_limit_t.hpp>

#include "lcm/message_fields.h"

namespace glissade::devices {

inline joint_limit_t limit_message(const JointLimit& limit) noexcept {
  joint_limit_t message;
  message.lower_rad = limit.lower;
  message.upper_rad = limit.upper;
  message.stiffness_Nm_per_rad = limit.stiffness;
  message.damping_Nm_s_per_rad = limit.damping;
  message.max_torque_Nm = limit.max_torque;
  return message;
}

inline JointLimit limit_of(const joint_limit_t& message) noexcept {
  return {.lower = message.lower_rad,
          .upper = message.upper_rad,
          .stiffness = message.stiffness_Nm_per_rad,
          .damping = message.damping_Nm_s_per_rad,
          .max_torque = message.max_torque_Nm};
}

/// Half-spaces without rows are zero, whatever the rest says.
half_spaces_t half_spaces_message(const HalfSpaces& half_spaces) noexcept;
HalfSpaces half_spaces_of(const half_spaces_t& message) noexcept;
void check_half_spaces(const half_spaces_t& message, FieldCheck& fields) noexcept;

}  // namespace glissade::devices

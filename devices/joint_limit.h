#pragma once

/// A limit of a finger joint that a device holds in its own loop, at its own rate. A force over a slow link must be
/// soft to be passive. A limit can be as stiff as the device's own loop permits, because only the limit crosses the
/// link.

#include <array>
#include <chrono>

#include <glissade/hands/hand.h>

namespace glissade::devices {

/// The absence of a limit, rad: beyond every joint's range, and finite for messages.
inline constexpr double kNoLimit_rad = 6.0;

/// A range of one joint. Beyond the range, a spring and damper push back, at most with `max_torque`. They never pull.
/// Within the range, the joint is free.
struct JointLimit {
  double lower = -kNoLimit_rad;  ///< rad
  double upper = kNoLimit_rad;   ///< rad
  double stiffness = 0.0;        ///< Nm/rad
  double damping = 0.0;          ///< Nm s/rad
  double max_torque = 0.0;       ///< Nm; 0: there is no limit

  bool operator==(const JointLimit&) const = default;
};

/// The torque (Nm, positive toward larger angles) of a limit on a joint with this angle (rad) and rate (rad/s).
double limit_torque(const JointLimit& limit, double angle, double rate) noexcept;

/// The energy (J) that the spring of a limit stores with the joint at this angle (rad).
double stored_energy(const JointLimit& limit, double angle) noexcept;

/// One limit per joint, in the order of `hands::kJointNames`.
struct JointLimits {
  std::array<JointLimit, hands::kJoints> joints{};
  /// A device that has heard nothing for so long opens all limits. The default is the watchdog of a device of 1 kHz.
  std::chrono::nanoseconds expiry{std::chrono::milliseconds(10)};

  bool operator==(const JointLimits&) const = default;
  bool any() const noexcept {
    for (const JointLimit& joint : joints) {
      if (joint.max_torque > 0.0) return true;
    }
    return false;
  }
};

}  // namespace glissade::devices

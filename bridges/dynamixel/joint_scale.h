#pragma once

/// Conversion between a joint and the registers of its servo.

#include <cstdint>

#include <glissade/bridges/dynamixel_hand.h>

#include "dynamixel/registers.h"

namespace glissade::bridges::dynamixel {

class JointScale {
 public:
  JointScale(const DynamixelHand& hand, const DynamixelServo& servo, const ServoModel& model) noexcept;

  /// Chooses the whole turn of the horn at which the joint is nearest to the middle of its range. After its supply was
  /// off, a servo knows its position only within a turn.
  void choose_turn(std::int64_t position, double lower, double upper) noexcept;

  double angle(std::int64_t position) const noexcept;  ///< rad
  double rate(std::int64_t velocity) const noexcept;   ///< rad/s
  std::int64_t position(double angle) const noexcept;  ///< of an angle in rad
  /// The cap of current for a torque (Nm) at the joint, at most that of the servo.
  std::int64_t current(double torque) const noexcept;
  /// The register Position P Gain for a stiffness (Nm/rad) of the joint.
  std::int64_t p_gain(double stiffness) const noexcept;

  std::int64_t max_current() const noexcept { return max_current_; }
  double max_torque() const noexcept;     ///< Nm at the joint
  double max_stiffness() const noexcept;  ///< Nm/rad at the joint, with the largest gain
  double play() const noexcept { return play_; }
  double resolution() const noexcept { return kPositionUnit_rad * absolute_ratio_; }

 private:
  double ratio_;
  double absolute_ratio_;
  double zero_;                // rad of the horn
  double torque_per_current_;  // Nm/A at the joint
  double stiffness_per_gain_;  // Nm/rad at the joint
  std::int64_t max_current_;   // counts
  double play_;                // rad of the joint
};

}  // namespace glissade::bridges::dynamixel

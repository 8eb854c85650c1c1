#pragma once

/// How a servo holds the limit of its joint.

#include <glissade/devices/glove_device.h>

namespace glissade::bridges::dynamixel {

/// What a servo is to do, in terms of its joint.
struct HoldGoal {
  bool has_torque = false;
  double angle = 0.0;       ///< goal position, rad
  double max_torque = 0.0;  ///< cap, Nm; the servo pushes and pulls with at most so much
  double stiffness = 0.0;   ///< Nm/rad

  bool operator==(const HoldGoal&) const = default;
};

/// A servo at a goal position pushes and pulls; a limit only pushes. So the servo is
///  - off while the joint is far inside its range;
///  - ready, with a cap of 0, near a limit, so that nothing must be switched at the contact;
///  - holding within the play of the gear and beyond the limit: goal and cap are those of the limit.
/// Each change has a hysteresis. At a change between ready and holding, the torque changes by at most the stiffness
/// times the play. Between off and ready it does not change. Pure: no clock.
class LimitHolder {
 public:
  /// `play` (rad of the joint) is the backlash of the gear.
  explicit LimitHolder(double play) noexcept;

  /// The goal for the newest joint angle (rad).
  HoldGoal update(const devices::JointLimit& limit, double angle) noexcept;

  /// Off, until the next `update`.
  void reset() noexcept { state_ = State::kOff; }

 private:
  enum class State { kOff, kReady, kHolding };

  State next_state(double inside) const noexcept;

  double play_;
  State state_ = State::kOff;
};

}  // namespace glissade::bridges::dynamixel

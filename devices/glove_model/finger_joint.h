#pragma once

/// One joint of a finger with its actuator: two inertias, coupled by a transmission with backlash and stiffness.

namespace glissade::devices {

/// The constants of a joint, in SI units at the joint.
struct FingerJointConstants {
  double inertia = 0.0;           ///< of finger and glove, kg m²
  bool is_driven = false;         ///< without an actuator, the constants below have no effect
  double actuator_inertia = 0.0;  ///< reflected to the joint, kg m²
  double viscous_friction = 0.0;  ///< of the actuator, Nm s/rad
  double backlash = 0.0;          ///< lost motion, rad
  double link_stiffness = 0.0;    ///< Nm/rad
  double link_damping = 0.0;      ///< Nm s/rad
  double lower = 0.0;             ///< range of the finger, rad
  double upper = 0.0;
};

/// What acts on a joint during a step.
struct FingerJointLoads {
  double aim = 0.0;               ///< rest angle of the wearer's spring, rad
  double stiffness = 0.0;         ///< of the wearer's spring, Nm/rad
  double damping = 0.0;           ///< of the finger, Nm s/rad
  double finger_torque = 0.0;     ///< further torque on the finger, Nm
  double actuator_torque = 0.0;   ///< Nm
  double friction_rising = 0.0;   ///< dry friction of the actuator against rising angles, Nm
  double friction_falling = 0.0;  ///< dry friction of the actuator against falling angles, Nm
};

/// Integrates by linearly implicit Euler, which is stable for any stiffness. The dry friction solves the
/// complementarity problem of the step exactly: the actuator sticks if friction can hold it. Source: Moreau, Unilateral
/// contact and dry friction in finite freedom dynamics, 1988; Acary and Brogliato, Numerical Methods for Nonsmooth
/// Dynamical Systems, 2008, §10.
class FingerJoint {
 public:
  /// Starts at rest at `angle` (rad), without load of the transmission.
  FingerJoint(const FingerJointConstants& constants, double angle) noexcept;

  /// Advances by `h` seconds. Cost O(1).
  void step(double h, const FingerJointLoads& loads) noexcept;

  double angle() const noexcept { return angle_; }                    ///< of the finger, rad
  double rate() const noexcept { return rate_; }                      ///< of the finger, rad/s
  double actuator_angle() const noexcept { return actuator_angle_; }  ///< rad at the joint
  double actuator_rate() const noexcept { return actuator_rate_; }    ///< rad/s at the joint
  double link_torque() const noexcept { return link_torque_; }        ///< of the transmission on the finger, Nm

 private:
  double link_deflection() const noexcept;
  void solve(double h, const FingerJointLoads& loads, double deflection, double stiffness, double damping) noexcept;

  FingerJointConstants constants_;
  double angle_;
  double rate_ = 0.0;
  double actuator_angle_;
  double actuator_rate_ = 0.0;
  double link_torque_ = 0.0;
};

}  // namespace glissade::devices

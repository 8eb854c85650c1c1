#include "glove_model/finger_joint.h"

#include <algorithm>

namespace glissade::devices {
namespace {

/// The impulse that is left when dry friction has taken its part: zero if friction holds.
double less_friction(double impulse, double against_rising, double against_falling) noexcept {
  if (impulse > against_rising) return impulse - against_rising;
  if (impulse < -against_falling) return impulse + against_falling;
  return 0.0;
}

}  // namespace

FingerJoint::FingerJoint(const FingerJointConstants& constants, double angle) noexcept
    : constants_(constants), angle_(angle), actuator_angle_(angle) {}

/// How far the transmission is stretched beyond its backlash; positive if it pushes the finger to larger angles.
double FingerJoint::link_deflection() const noexcept {
  const double difference = actuator_angle_ - angle_;
  const double half = 0.5 * constants_.backlash;
  return difference - std::clamp(difference, -half, half);
}

void FingerJoint::step(double h, const FingerJointLoads& loads) noexcept {
  const double old_rate = rate_;
  const double old_actuator_rate = actuator_rate_;
  const double deflection = constants_.is_driven ? link_deflection() : 0.0;
  const bool has_backlash = constants_.backlash > 0.0;
  const bool is_open = !constants_.is_driven || (has_backlash && deflection == 0.0);
  solve(h, loads, deflection, is_open ? 0.0 : constants_.link_stiffness, is_open ? 0.0 : constants_.link_damping);
  if (has_backlash && link_torque_ * deflection < 0.0) {  // teeth push, and do not pull
    rate_ = old_rate;
    actuator_rate_ = old_actuator_rate;
    solve(h, loads, 0.0, 0.0, 0.0);
  }
  actuator_angle_ += h * actuator_rate_;
  const double angle = angle_ + h * rate_;
  angle_ = std::clamp(angle, constants_.lower, constants_.upper);
  if (angle != angle_) rate_ = 0.0;
}

/// The rates at the end of the step satisfy, with the index f of the finger, m of the actuator, and t the torque of the
/// transmission,
///   inertia_f (rate_f' − rate_f) = h [stiffness (aim − angle_f − h rate_f') − damping rate_f' + torque_f + t']
///   inertia_m (rate_m' − rate_m) = h [torque_m − viscous_friction rate_m' − t' − friction(rate_m')]
///   t' = link_stiffness (deflection + h (rate_m' − rate_f')) + link_damping (rate_m' − rate_f').
/// Elimination of rate_f' leaves one equation for rate_m', which the dry friction solves by subtraction.
void FingerJoint::solve(double h, const FingerJointLoads& loads, double deflection, double stiffness,
                        double damping) noexcept {
  const double coupling = h * (h * stiffness + damping);
  const double spring = loads.stiffness * (loads.aim - angle_) + loads.finger_torque + stiffness * deflection;
  const double finger_impulse = constants_.inertia * rate_ + h * spring;
  const double finger_inertia = constants_.inertia + h * (loads.damping + h * loads.stiffness) + coupling;
  if (constants_.is_driven) {
    const double share = coupling / finger_inertia;
    const double actuator_impulse =
        constants_.actuator_inertia * actuator_rate_ + h * (loads.actuator_torque - stiffness * deflection);
    const double actuator_inertia = constants_.actuator_inertia + h * constants_.viscous_friction + coupling;
    const double moving =
        less_friction(actuator_impulse + share * finger_impulse, h * loads.friction_rising, h * loads.friction_falling);
    actuator_rate_ = moving / (actuator_inertia - share * coupling);
  }
  rate_ = (finger_impulse + coupling * actuator_rate_) / finger_inertia;
  link_torque_ = stiffness * deflection + coupling / h * (actuator_rate_ - rate_);
}

}  // namespace glissade::devices

#include "glove_model/finger_dynamics.h"

#include <algorithm>

#include "glove_model/finger_table.h"

namespace glissade::devices {
namespace {

constexpr double kStep_s = std::chrono::duration<double>(kFingerStep).count();

bool has_actuators(FingerKind kind) {
  return kind == FingerKind::kTorque || kind == FingerKind::kJointLimit || kind == FingerKind::kBrake;
}

FingerJointConstants constants_of(const GloveModel& model, std::size_t joint) {
  const CarriedPart& part = kCarriedParts[joint];
  const ActuatorModel& actuator = model.actuator;
  return {.inertia = part.inertia + model.wearer.glove_tip_mass * part.lever * part.lever,
          .is_driven = has_actuators(model.fingers) && actuator.is_driven[joint],
          .actuator_inertia = actuator.rotor_inertia * actuator.gear_ratio * actuator.gear_ratio,
          .viscous_friction = actuator.viscous_friction,
          .backlash = actuator.backlash,
          .link_stiffness = actuator.link_stiffness,
          .link_damping = actuator.link_damping,
          .lower = radians(hands::kJointRanges[joint].lower_deg),
          .upper = radians(hands::kJointRanges[joint].upper_deg)};
}

}  // namespace

FingerDynamics::FingerDynamics(const GloveModel& model, const hands::JointValues& angles)
    : model_(model), wearer_(model.wearer, angles, model.seed, kStep_s), angles_(angles), actuator_angles_(angles) {
  joints_.reserve(hands::kJoints);
  for (std::size_t i = 0; i < hands::kJoints; ++i)
    joints_.emplace_back(constants_of(model, i), angles[i]);
  if (has_actuators(model.fingers)) actuators_.emplace(model, angles);
  if (model.fingers == FingerKind::kCurlLimit) strings_.emplace(model);
}

void FingerDynamics::advance(std::chrono::nanoseconds dt, const hands::JointValues& aims, bool is_closed,
                             const FingerOrder& order) noexcept {
  const double grip = is_closed ? model_.wearer.grip : model_.wearer.open_grip;
  FingerOrder aging = order;
  aging.age -= rest_;
  rest_ += std::max(dt, std::chrono::nanoseconds(0));
  while (rest_ >= kFingerStep) {
    rest_ -= kFingerStep;
    aging.age += kFingerStep;
    step(aims, grip, aging);
  }
}

void FingerDynamics::step(const hands::JointValues& aims, double grip, const FingerOrder& order) noexcept {
  const std::chrono::nanoseconds now = steps_ * kFingerStep;
  wearer_.advance(angles_, loads_);
  if (actuators_) actuators_->advance(now, kStep_s, order, actuator_angles_);
  if (strings_) strings_->advance(now, kStep_s, order, angles_, rates_);
  const double friction = model_.actuator.coulomb_friction;
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    FingerJointLoads loads;
    loads.aim = wearer_.aim(i, aims[i], grip);
    loads.stiffness = wearer_.stiffness(i, grip);
    loads.damping = loads.stiffness * model_.wearer.damping_time;
    if (strings_) loads.finger_torque = strings_->torque(i);
    if (actuators_) {
      loads.actuator_torque = actuators_->motor_torque(i);
      loads.friction_rising = friction + actuators_->brake_rising(i);
      loads.friction_falling = friction + actuators_->brake_falling(i);
    }
    FingerJoint& joint = joints_[i];
    joint.step(kStep_s, loads);
    angles_[i] = joint.angle();
    rates_[i] = joint.rate();
    actuator_angles_[i] = joint.actuator_angle();
    actuator_rates_[i] = joint.actuator_rate();
    loads_[i] = joint.link_torque() + loads.finger_torque;
  }
  ++steps_;
}

}  // namespace glissade::devices

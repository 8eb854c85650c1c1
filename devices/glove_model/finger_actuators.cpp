#include "glove_model/finger_actuators.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::devices {
namespace {

bool is_exhausted(const FingerOrder& order) noexcept {
  return order.limits == nullptr || order.age > order.limits->expiry;
}

/// The limit at the actuator, which a finger that presses takes along by half of the backlash.
JointLimit at_actuator(JointLimit limit, double backlash) noexcept {
  limit.lower += 0.5 * backlash;
  limit.upper -= 0.5 * backlash;
  return limit;
}

}  // namespace

double quantised(double angle, double resolution) noexcept {
  return resolution > 0.0 ? resolution * std::floor(angle / resolution + 0.5) : angle;
}

FingerActuators::FingerActuators(const GloveModel& model, const hands::JointValues& angles)
    : kind_(model.fingers),
      actuator_(model.actuator),
      servo_(model.servo),
      period_(nanoseconds_of(1.0 / model.servo.rate)),
      delay_(nanoseconds_of(model.servo.delay)),
      measured_(angles),
      on_the_way_(delay_line_capacity(model.servo.delay, model.servo.rate)) {
  for (double& angle : measured_)
    angle = quantised(angle, servo_.resolution);
}

void FingerActuators::measure(std::chrono::nanoseconds now, const FingerOrder& order,
                              const hands::JointValues& angles) noexcept {
  hands::JointValues wanted{};
  const bool has_limits = kind_ != FingerKind::kTorque && !is_exhausted(order);
  for (std::size_t i = 0; i < hands::kJoints; ++i) {
    const double angle = quantised(angles[i], servo_.resolution);
    const double rate = (angle - measured_[i]) * servo_.rate;
    measured_[i] = angle;
    if (!actuator_.is_driven[i]) continue;
    if (kind_ == FingerKind::kTorque) wanted[i] = order.torques[i];
    if (has_limits) wanted[i] = limit_torque(at_actuator(order.limits->joints[i], actuator_.backlash), angle, rate);
  }
  on_the_way_.push(wanted, now + delay_);
}

void FingerActuators::advance(std::chrono::nanoseconds now, double h, const FingerOrder& order,
                              const hands::JointValues& angles) noexcept {
  if (now >= next_) {
    measure(now, order, angles);
    next_ += period_;
  }
  on_the_way_.take(now, wanted_);
  const double lag = 2.0 * std::numbers::pi * actuator_.bandwidth * h;
  const double share = lag / (1.0 + lag);  // implicit Euler, like the joints
  const double most = actuator_.motor_torque + actuator_.brake_torque;
  for (std::size_t i = 0; i < hands::kJoints; ++i)
    exerted_[i] += share * (std::clamp(wanted_[i], -most, most) - exerted_[i]);
}

double FingerActuators::motor_torque(std::size_t joint) const noexcept {
  return std::clamp(exerted_[joint], -actuator_.motor_torque, actuator_.motor_torque);
}

double FingerActuators::brake_rising(std::size_t joint) const noexcept {
  return std::max(0.0, -exerted_[joint] - actuator_.motor_torque);
}

double FingerActuators::brake_falling(std::size_t joint) const noexcept {
  return std::max(0.0, exerted_[joint] - actuator_.motor_torque);
}

}  // namespace glissade::devices

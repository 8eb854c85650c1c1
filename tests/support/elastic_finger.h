#pragma once

/// A finger with a closed form, at the horn of an emulated servo.

#include <cmath>

#include "dynamixel/horn_load.h"

namespace glissade::bridges::dynamixel {

/// A finger of the first order, without mass: the wearer pulls it toward `aim` by a spring, against the viscous
/// friction of finger and gear. Exact for a constant torque.
class ElasticFinger final : public HornLoad {
 public:
  ElasticFinger(double angle, double stiffness, double damping) noexcept
      : aim(angle), angle_(angle), stiffness_(stiffness), damping_(damping) {}

  double angle() const noexcept override { return angle_; }
  double rate() const noexcept override { return rate_; }
  void step(double torque, double dt) noexcept override {
    const double rest = aim + torque / stiffness_;
    const double next = rest + (angle_ - rest) * std::exp(-stiffness_ / damping_ * dt);
    rate_ = (next - angle_) / dt;
    angle_ = next;
  }

  double aim;  ///< where the wearer wants the finger, rad

 private:
  double angle_;
  double rate_ = 0.0;
  double stiffness_;  // Nm/rad
  double damping_;    // Nm s/rad
};

}  // namespace glissade::bridges::dynamixel

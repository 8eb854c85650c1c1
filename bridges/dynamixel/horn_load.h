#pragma once

/// What the horn of an emulated servo turns.

namespace glissade::bridges::dynamixel {

/// A load at the horn, in the horn's coordinates.
class HornLoad {
 public:
  virtual ~HornLoad() = default;

  virtual double angle() const noexcept = 0;  ///< rad
  virtual double rate() const noexcept = 0;   ///< rad/s

  /// Lets `dt` (seconds) pass under the servo's torque (Nm).
  virtual void step(double torque, double dt) noexcept = 0;
};

}  // namespace glissade::bridges::dynamixel

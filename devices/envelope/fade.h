#pragma once

#include <algorithm>
#include <cstddef>

#include "envelope/envelope_settings.h"
#include "envelope/forces.h"

namespace glissade::devices {

/// The force that fades within seven periods, and returns softly within 200 ms.
class Fade {
 public:
  Fade(const DeviceDescriptor& descriptor, double period_s)
      : descriptor_(descriptor), fade_s_(kEnvelope.fade_periods * period_s) {}

  void advance(bool is_fading, double dt) noexcept {
    gain_ = std::clamp(gain_ + (is_fading ? -dt / fade_s_ : dt / kEnvelope.return_s), 0.0, 1.0);
  }

  bool is_whole() const noexcept { return gain_ == 1.0; }
  /// The share of a force that returns, from 0 to 1.
  double gain() const noexcept { return gain_; }

  /// The return begins at zero, however soon the force was there.
  void begin_at_zero() noexcept { gain_ = 0.0; }

  Forces returning(Forces wanted) const noexcept {
    wanted.scale_wrench(gain_);
    for (double& torque : wanted.joints)
      torque *= gain_;
    return wanted;
  }

  /// Straight to zero, so that a change of the wanted direction cannot make the fade longer.
  Forces fading(const Forces& last, double dt) const noexcept {
    const double share = dt / fade_s_;
    const auto shorter = [](const Eigen::Vector3d& vector, double by) {
      const double norm = vector.norm();
      return norm > by ? Eigen::Vector3d((1.0 - by / norm) * vector) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    };
    Forces forces{shorter(last.f, share * descriptor_.max_force), shorter(last.t, share * descriptor_.max_torque), {}};
    const double by = share * descriptor_.max_joint_torque;
    for (std::size_t i = 0; i < hands::kJoints; ++i)
      forces.joints[i] = last.joints[i] - std::clamp(last.joints[i], -by, by);
    return forces;
  }

 private:
  const DeviceDescriptor& descriptor_;
  double fade_s_;
  double gain_ = 0.0;
};

}  // namespace glissade::devices

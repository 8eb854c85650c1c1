#pragma once

#include <Eigen/Core>

#include <glissade/devices/glove_device.h>

namespace glissade::devices {

/// On the hand and its joints: N, Nm, Nm.
struct Forces {
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  hands::JointValues joints{};

  bool has_wrench() const noexcept { return !f.isZero(0.0) || !t.isZero(0.0); }

  void scale_wrench(double share) noexcept {
    f *= share;
    t *= share;
  }
};

}  // namespace glissade::devices

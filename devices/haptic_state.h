#pragma once

/// One haptic tick as viewers and recorders see it. Frames: W world, G ghost, V visible part.

#include <chrono>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace glissade::devices {

struct HapticState {
  std::int64_t sequence = 0;
  std::chrono::nanoseconds time{0};
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  Eigen::Vector3d force_on_hand_W = Eigen::Vector3d::Zero();     ///< N
  Eigen::Vector3d torque_on_hand_V_W = Eigen::Vector3d::Zero();  ///< Nm, about the origin of V, in world axes
  std::int32_t contact_count = 0;
  std::chrono::nanoseconds contact_set_age{0};
  bool is_in_contact = false;
  bool is_force_limited = false;     ///< the wrench was cut to the device's limits
  bool is_contact_set_late = false;  ///< the simulation had not renewed the contact set in time
  bool has_no_device = false;        ///< no fresh glove state
};

}  // namespace glissade::devices

#pragma once

/// The spring of half-spaces at one pose of the hand.

#include <glissade/devices/glove_device.h>
#include <glissade/geometry/displacement.h>

namespace glissade::devices {

/// In coordinates (v, ρ w) with ρ² = K_r / K, the spring has the same stiffness K in all directions, and its wrench is
/// (f, t / ρ). So its size and its energy follow from one depth. Real-time safe.
class HeldSpring {
 public:
  /// `half_spaces` must outlive the spring.
  HeldSpring(const HalfSpaces& half_spaces, const Eigen::Isometry3d& X_WH) noexcept;

  /// The way (metres) to the nearest displacement within all half-spaces. 0 if they contradict each other.
  double depth() const noexcept { return depth_; }
  /// The rate (m/s) at which the depth grows, for a velocity of the hand root and an angular velocity.
  double closing(const Eigen::Vector3d& v_WH, const Eigen::Vector3d& w_WH) const noexcept;
  /// The size of the wrench without damping, N: at most `max_force`.
  double size() const noexcept;
  /// The wrench of this size on the hand root. Its torque is at most `max_torque`.
  HandWrench wrench(double size) const noexcept;
  double energy() const noexcept;  ///< J
  /// The largest force with which the energy is at most `joules`.
  double force_for(double joules) const noexcept;

 private:
  const HalfSpaces& half_spaces_;
  double radius_ = 0.0;           // ρ, metres
  Eigen::Vector3d p_HR_W_;        // metres
  geometry::Vector6d direction_;  // unit, of the wrench about R
  double depth_ = 0.0;
};

}  // namespace glissade::devices

#pragma once

/// The virtual coupling: the spring and damper between the hand and the visible part, their limits, and the wrench that
/// the hand feels. Frames: W world, G ghost, V visible part.

#include <chrono>

#include <Eigen/Core>

#include <glissade/geometry/displacement.h>

namespace glissade::devices {
struct DeviceDescriptor;
}

namespace glissade::haptics {

/// The period of the haptic loop. Force-feedback devices expect a rate of 1 kHz.
inline constexpr std::chrono::milliseconds kTickPeriod{1};

/// The lag of a part is the displacement from the visible part to its target (`SlidingResult`). Under force feedback,
/// the lag changes in a tick by at most kSlew_m (metres) plus the ghost's own motion. This limit bounds the change of
/// the force when the part snaps into a gap.
inline constexpr double kSlew_m = 0.2e-3;

/// Stiffness of the spring against translation (N/m) and rotation (Nm/rad) of the part's reference point. The stiffness
/// is also the metric of the projection on the contacts, so that the coupling wrench is exactly a sum of contact
/// normals.
struct CouplingStiffness {
  double translational;
  double rotational;
};

/// Damping against translation (N s/m) and rotation (Nm s/rad) of the part's reference point.
struct CouplingDamping {
  double translational;
  double rotational;
};

/// Spring and damper.
struct Coupling {
  CouplingStiffness stiffness;
  CouplingDamping damping;
};

/// The stiffness with which a part of the given radius (metres) is held by default: k_t = 1000 N/m, k_r = k_t ρ².
CouplingStiffness default_stiffness(double radius);

/// The coupling that a device can render without shaking. The stiffness is `wanted`, lowered to the limits of the
/// descriptor. The damping is 5 ms times this stiffness; the translational damping is lowered to the descriptor's limit
/// too. Throws std::invalid_argument, naming the device, when the device cannot render any stiffness against
/// translation or rotation.
Coupling coupling_for(const devices::DeviceDescriptor& device, const CouplingStiffness& wanted);

/// Force (N) and torque (Nm) on a body about some point, in world axes.
struct Wrench {
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// The same wrench about the point `to` instead of the point `from`, both in world coordinates (metres).
Wrench about_point(const Wrench& wrench, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The spring's wrench on the hand about the ghost's reference point: −K ξ*, where K is `stiffness` and ξ* is `error`,
/// the displacement from the visible part to the ghost. Exactly zero when part and ghost coincide. Because the part was
/// projected on the contacts in the metric of K, the wrench is a sum of contact normals: sliding is frictionless.
Wrench spring_wrench(const CouplingStiffness& stiffness, const geometry::Displacement& error);

/// Velocity of the ghost's reference point (m/s) and angular velocity of the ghost (rad/s), in world axes.
struct Velocity {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
};

/// The damper's wrench on the hand. The damper acts along the spring's force and torque only, because a part moves
/// freely in directions perpendicular to the contact normals of fixed obstacles. The damper never exceeds the spring's
/// force and torque. So it sets in smoothly when contact is made, and never pulls the hand towards a contact that the
/// hand leaves.
Wrench damper_wrench(const CouplingDamping& damping, const Wrench& spring, const Velocity& ghost);

}  // namespace glissade::haptics

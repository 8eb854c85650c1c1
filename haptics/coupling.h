#pragma once

/// The virtual coupling: the spring and damper between the hand and the visible part, their limits, and the wrench that
/// the hand feels. The ghost is the pose that the part would have if nothing were in the way.

#include <chrono>
#include <string>

#include <Eigen/Core>

#include <glissade/geometry/displacement.h>

namespace glissade::devices {
struct DeviceDescriptor;
}

namespace glissade::haptics {

/// The usual period of the haptic loop, and the bounds of those that can be chosen: 5 kHz and 500 Hz.
inline constexpr std::chrono::milliseconds kTickPeriod{1};
inline constexpr std::chrono::microseconds kShortestTickPeriod{200};
inline constexpr std::chrono::milliseconds kLongestTickPeriod{2};

/// Throws std::invalid_argument unless `period` lies within these bounds.
void validate_tick_period(std::chrono::nanoseconds period);

/// The lag of a part is the displacement from the visible part to its target (`SlidingResult`). Under force feedback,
/// the lag changes in a millisecond by at most kSlew_m (metres) plus the motion of the ghost, or of all ghosts if there
/// are several parts. This limit bounds the change of the force when the part snaps into a
/// gap.
inline constexpr double kSlew_m = 0.2e-3;

/// Stiffness of the spring against translation (N/m) of the part's reference point and rotation (Nm/rad) about it. The
/// simulation projects the wanted displacement of the part on the displacements that the contacts allow. The stiffness
/// is also the metric of this projection, so that the wrench of the spring on a part at rest is a sum of forces along
/// contact normals.
struct CouplingStiffness {
  double translational;
  double rotational;
};

/// Throws std::invalid_argument, naming the part by `part_name`, unless both numbers are positive and finite.
void validate(const CouplingStiffness& stiffness, const std::string& part_name);

/// Damping against translation (N s/m) of the ghost's reference point and rotation (Nm s/rad) about it.
struct CouplingDamping {
  double translational;
  double rotational;
};

/// Spring and damper.
struct Coupling {
  CouplingStiffness stiffness;
  CouplingDamping damping;
};

/// The default stiffness for a part of radius ρ (metres): 1000 N/m against translation and ρ² times that against
/// rotation.
CouplingStiffness default_stiffness(double radius);

/// The greatest stiffness with which a spring on the device is passive, i.e. never gives back more energy than the hand
/// put in: b / (T/2 + t_d), with the device's damping b, the period T of the loop and the delay t_d from measurement to
/// force; against translation also at most twice the Coulomb friction by the resolution. A damping that the descriptor
/// does not tell is taken as the least with which the maker's largest stiffness is passive without a link. Sources:
/// Colgate and Schenkel, Passivity of a class of sampled-data systems, 1997; Abbott and Okamura, Effects of position
/// quantization and sampling rate on virtual-wall passivity, 2005.
CouplingStiffness passive_stiffness(const devices::DeviceDescriptor& device, std::chrono::nanoseconds period,
                                    std::chrono::nanoseconds delay) noexcept;

/// The coupling that a device can render without shaking in a loop of this period, at least that of the device. `delay`
/// is the delay of the link, which adds to the device's own. The stiffness is `wanted`, lowered to the limits of the
/// descriptor and to `passive_stiffness`. The damping is 5 ms times this stiffness, but at most the descriptor's limit,
/// and at most what the device's own damping leaves: b − K (T/2 + t_d). Throws std::invalid_argument, naming the
/// device, when the device cannot render any stiffness against translation or rotation.
Coupling coupling_for(const devices::DeviceDescriptor& device, const CouplingStiffness& wanted,
                      std::chrono::nanoseconds period = kTickPeriod,
                      std::chrono::nanoseconds delay = std::chrono::nanoseconds(0));

/// The same without the check, for a part whose reference point is `lever` (metres) from the device's. There the spring
/// against translation also turns the device, like a spring of K l² against rotation, for which the device's rotational
/// damping has to suffice, too. Real-time safe.
Coupling coupling_within_limits(const devices::DeviceDescriptor& device, const CouplingStiffness& wanted,
                                std::chrono::nanoseconds period, std::chrono::nanoseconds delay,
                                double lever = 0.0) noexcept;

/// Force (N) and torque (Nm) on a body about some point, in world axes.
struct Wrench {
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// The wrench times a factor.
inline Wrench scaled(const Wrench& wrench, double factor) {
  return {factor * wrench.f, factor * wrench.t};
}

/// The same wrench about the point `to` instead of the point `from`, both in world coordinates (metres).
Wrench about_point(const Wrench& wrench, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The spring's wrench on the hand about the ghost's reference point: −K ξ*, where K is `stiffness` and ξ* is `error`,
/// the displacement from the visible part to its target (which is the ghost, unless the part was grasped at an offset).
/// Exactly zero when `error` is zero. Because the part was projected on the contacts in the metric K, the
/// wrench is a sum of forces along contact normals: without `SlidingRules::friction`, the hand feels no friction.
Wrench spring_wrench(const CouplingStiffness& stiffness, const geometry::Displacement& error);

/// Velocity of the ghost's reference point (m/s) and angular velocity of the ghost (rad/s), in world axes.
struct Velocity {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
};

/// The damper's wrench on the hand. The damper acts along the force and the torque of the contacts only. So it does not
/// brake a translation perpendicular to the contact normals, and obstacles do not resist such a translation either. The
/// damper's force never exceeds that of the contacts, nor its torque theirs. So the damper sets in smoothly at a new
/// contact, and both together never pull the hand towards a contact that the hand leaves.
Wrench damper_wrench(const CouplingDamping& damping, const Wrench& contacts, const Velocity& ghost);

}  // namespace glissade::haptics

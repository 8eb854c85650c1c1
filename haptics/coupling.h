#pragma once

/// The virtual coupling on a device: the spring (`contact/spring.h`) and the damper between the hand and the visible
/// part, within the limits of the device. The ghost is the pose that the part would have if nothing were in the way.

#include <chrono>

#include <Eigen/Core>

#include <glissade/base/export.h>
#include <glissade/contact/spring.h>

namespace glissade::devices {
struct DeviceDescriptor;
}

namespace glissade::haptics {

/// The default, the shortest and the longest period of the haptic loop (1 kHz, 5 kHz and 500 Hz).
inline constexpr std::chrono::milliseconds kTickPeriod{1};
inline constexpr std::chrono::microseconds kShortestTickPeriod{200};
inline constexpr std::chrono::milliseconds kLongestTickPeriod{2};

/// Throws std::invalid_argument if `period` lies outside these bounds.
GLISSADE_EXPORT void validate_tick_period(std::chrono::nanoseconds period);

/// Damping against translation of the ghost's reference point (N s/m), and against rotation about this point (Nm
/// s/rad).
struct CouplingDamping {
  double translational;
  double rotational;
};

/// Spring and damper.
struct Coupling {
  contact::CouplingStiffness stiffness;
  CouplingDamping damping;
};

/// The greatest stiffness with which a spring on the device is passive, i.e. never gives back more energy than the hand
/// put in: b / (T/2 + t_d), with the device's damping b, the period T of the loop and the delay t_d from measurement to
/// force. The stiffness against translation is also at most twice the Coulomb friction divided by the resolution. If
/// the descriptor does not give the damping, b is the smallest damping with which the maker's largest stiffness is
/// passive if the link adds no delay. Sources: Colgate and Schenkel, Passivity of a class of sampled-data systems,
/// 1997; Abbott and Okamura, Effects of position quantization and sampling rate on virtual-wall passivity, 2005.
GLISSADE_EXPORT contact::CouplingStiffness passive_stiffness(const devices::DeviceDescriptor& device,
                                                             std::chrono::nanoseconds period,
                                                             std::chrono::nanoseconds delay) noexcept;

/// The coupling that a device can render without shaking. T is the longer of `period` and the period of the device.
/// `delay` is the delay of the link, which adds to the device's own delay. The stiffness K is the least of `wanted`,
/// the descriptor's limit and `passive_stiffness`. The damping is the least of 5 ms times K, the descriptor's limit,
/// and b − K (T/2 + t_d) with the device's own damping b. Throws std::invalid_argument, naming the device, when the
/// device cannot render any stiffness against translation or rotation.
GLISSADE_EXPORT Coupling coupling_for(const devices::DeviceDescriptor& device, const contact::CouplingStiffness& wanted,
                                      std::chrono::nanoseconds period = kTickPeriod,
                                      std::chrono::nanoseconds delay = std::chrono::nanoseconds(0));

/// Like `coupling_for`, but without the check, and for a part whose reference point is at the distance l = `lever`
/// (metres) from that of the device. The spring against translation then also turns the device, like a spring of the
/// stiffness K l² against rotation. The device's rotational damping must keep this spring passive, too.
/// `max_rotational_stiffness` does not limit this spring.
///
/// Half-spaces of a part that presses on a part in another hand move with their own hand, by way of the other part, and
/// late by the period and the delay of the link. For these, the lag of the device's own loop is not all. `of_link`,
/// from 0 to 1, is the share of the way from that lag to the lag of a wrench over the link. Real-time safe.
GLISSADE_EXPORT Coupling coupling_within_limits(const devices::DeviceDescriptor& device,
                                                const contact::CouplingStiffness& wanted,
                                                std::chrono::nanoseconds period, std::chrono::nanoseconds delay,
                                                double lever = 0.0, double of_link = 0.0) noexcept;

/// The damper's wrench on the hand, for the velocity v_W of the ghost's reference point (m/s) and the angular velocity
/// w_W of the ghost (rad/s). The damper acts along the force and the torque of the contacts only. So the damper does
/// not brake a translation perpendicular to the contact normals. The damper's force never exceeds the force of the
/// contacts, and its torque never exceeds their torque. So the damper sets in smoothly at a new contact. Contacts and
/// damper together never pull the hand towards a contact that the hand leaves.
GLISSADE_EXPORT contact::Wrench damper_wrench(const CouplingDamping& damping, const contact::Wrench& contacts,
                                              const Eigen::Vector3d& v_W, const Eigen::Vector3d& w_W);

}  // namespace glissade::haptics

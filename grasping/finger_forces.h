#pragma once

/// What the fingers in a glove feel: at each joint a spring that holds it where an object stops the visible hand.

#include <chrono>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/glove_device.h>
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/kinematic_chain.h>
#include <glissade/haptics/coupling.h>

namespace glissade::grasping {

/// The stiffness (Nm/rad) of the spring at each joint of a glove. It reaches `max_joint_torque` 0.8 degrees deep, so
/// that a finger which the wearer presses with less stops within this angle. Where that is more than the glove can
/// render passively, i.e. without ever giving back more energy than the finger put in, it is b / (T/2 + t_d), with the
/// joint's damping b, the period T of the loop, at least that of the device, and the delay t_d of device and link
/// (`haptics::passive_stiffness`). A glove that does not tell its `joint_damping` has no such limit. Real-time safe.
double finger_stiffness(const devices::DeviceDescriptor& device, std::chrono::nanoseconds period,
                        std::chrono::nanoseconds link_delay) noexcept;

/// Torques for the joints of a glove whose hand clasps something. A joint is pushed back by the spring if its own
/// motion, from the visible hand's posture to the glove's, goes deeper into a contact: as far as this motion is to
/// blame for the depth of that contact. All other joints get exactly zero; so do all while nothing touches.
///
/// The torque is continuous in the posture of the glove, and comes and goes with the depth. Contacts that push less
/// than 2 mm beside a joint's axis count less, down to nothing. The wearer's fingers rest where their muscles balance
/// the spring: a joint that presses with τ Nm, at most the largest torque, τ / stiffness deeper than the visible hand.
///
/// There is no damper: gloves measure angles, often in coarse steps, and no rates. What the spring may do without one
/// is in its stiffness.
///
/// Not thread-safe. Real-time safe after construction: no allocation, no lock, no system call.
class FingerForces {
 public:
  /// Joint i of the device sets value i of the chain. Joints that the device does not have, and those beyond the values
  /// of the chain, get no torque. Throws std::invalid_argument for a null chain, for more values than a glove has
  /// joints, and as `devices::validate` and `haptics::validate_tick_period` do.
  FingerForces(std::shared_ptr<const KinematicChain> chain, const devices::DeviceDescriptor& device,
               std::chrono::nanoseconds period = haptics::kTickPeriod);

  /// From now on the delay of the link, measured at the glove (`GloveState::link_delay`), limits the stiffness.
  void set_link_delay(std::chrono::nanoseconds delay) noexcept;

  /// Nm/rad, at present.
  double stiffness() const noexcept { return stiffness_; }

  /// The torques (Nm, positive toward larger angles) for a glove with these joint angles (rad), where the visible hand
  /// has the posture and the contacts of a `Clasp`. They are full where these are up to 20 ms old, and zero from 100 ms
  /// on. Zero for angles that are not finite. Cost: O(contacts · values), 1 µs and 0.1 µs a contact.
  const devices::JointValues& update(const devices::JointValues& angles, const Posture& visible,
                                     std::span<const LinkContact> contacts,
                                     std::chrono::nanoseconds age_of_contacts = std::chrono::nanoseconds(0)) noexcept;

 private:
  void find_rates(const LinkContact& contact) noexcept;
  void press(const LinkContact& contact) noexcept;

  std::shared_ptr<const KinematicChain> chain_;
  devices::DeviceDescriptor device_;
  std::chrono::nanoseconds period_;
  double stiffness_;
  std::vector<Eigen::Isometry3d> X_WL_;  // of the visible hand
  devices::JointValues lags_{};          // rad, from the visible hand to the glove
  devices::JointValues rates_{};         // m/rad, by which a value opens the gap of the contact in question
  devices::JointValues depths_{};        // rad, by which the lag of a joint goes into contacts
  devices::JointValues torques_{};
};

}  // namespace glissade::grasping

#pragma once

/// What the fingers in a glove feel: at each joint a spring that holds it where an object stops the visible hand.

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/devices/glove_device.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

namespace glissade::grasping {
class GraspSimulation;
struct HandModel;
}  // namespace glissade::grasping

namespace glissade::haptics {

/// A hinge between the hand root and the palm: frames P, the one before, and J, which turns by the angle about
/// `axis_J`.
struct WristJoint {
  std::size_t angle = 0;  ///< number of the glove's joint
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis_J = Eigen::Vector3d::UnitX();  ///< of unit length
};

/// A hand with fingers in the simulation, as far as the kernel knows it.
struct FingerHand {
  hands::JointValues lower{};  ///< range of each joint, rad
  hands::JointValues upper{};
  std::vector<WristJoint> wrist{};  ///< from the hand root on; a part in the hand moves with the frame of the last one
};

/// That of a hand of the simulation.
FingerHand finger_hand(const grasping::HandModel& hand);

/// The stiffness (Nm/rad) of the spring at each joint of a glove. It reaches `max_joint_torque` 0.8 degrees deep, so
/// that a finger which the wearer presses with less stops within this angle. Where that is more than the glove can
/// render passively, i.e. without ever giving back more energy than the finger put in, it is b / (T/2 + t_d), with the
/// joint's damping b, the period T of the loop, at least that of the device, and the delay t_d of device and link
/// (`passive_stiffness`). A glove that does not tell its `joint_damping` is taken to have just as
/// much as the full stiffness needs without a link. A torque that may change by r Nm/s (`devices::joint_torque_rate`)
/// lags behind a finger that taps quickly, and would feed its rattling: so the stiffness is at most r / (6 rad/s).
/// Where the angles are measured in steps, nothing damps a finger within a step: so it is also at most twice the
/// joint's Coulomb friction by the step. Real-time safe.
double finger_stiffness(const devices::DeviceDescriptor& device, std::chrono::nanoseconds period,
                        std::chrono::nanoseconds link_delay) noexcept;

/// How far (rad) the joints whose lag closes the gap of a contact have to go back to leave it, by the least squares,
/// and none farther than to the visible hand: raises `depths` to it. `lags`, rad, are from the visible hand to the
/// glove. The torques of the depths of one contact are the gradient of a convex energy in the closing joints, and no
/// stiffer than each joint alone: joints that share a contact do not add up. (Less where an arm is shorter than 2 mm.
/// Of several contacts a joint takes the greatest depth, so n joints may be stiffer by (1 + √n) / 2.) Real-time safe:
/// O(joints²) at worst.
void deepen(const FingerRow& row, const hands::JointValues& lags, hands::JointValues& depths) noexcept;

/// Torques for the joints of a glove whose hand clasps something. The joints whose own motion, from the visible hand's
/// posture to the glove's, goes deeper into a contact are pushed back by springs, as far as they together have to go to
/// leave it (`deepen`). All other joints get exactly zero; so do all while nothing touches.
///
/// The torque is continuous in the posture of the glove, and comes and goes with the depth. Contacts that push less
/// than 2 mm beside a joint's axis count less, down to nothing. The wearer's fingers rest where their muscles balance
/// the spring: a joint that presses with τ Nm, at most the largest torque, τ / stiffness deeper than the visible hand.
///
/// There is no damper: gloves measure angles, often in coarse steps, and no rates. What the spring may do without one
/// is in its stiffness.
///
/// Not thread-safe. Real-time safe: no allocation, no lock, no system call.
class FingerForces {
 public:
  /// Joints that the device does not have get no torque. Throws std::invalid_argument as `devices::validate` and
  /// `validate_tick_period` do, and for limits of the hand that are no numbers or the wrong way round.
  FingerForces(const FingerHand& hand, const devices::DeviceDescriptor& device,
               std::chrono::nanoseconds period = kTickPeriod);

  /// From now on the delay of the link, measured at the glove (`GloveState::link_delay`), limits the stiffness.
  void set_link_delay(std::chrono::nanoseconds delay) noexcept;

  /// Nm/rad, at present.
  double stiffness() const noexcept { return stiffness_; }
  /// Nm, of the device.
  double max_torque() const noexcept { return device_.max_joint_torque; }

  /// The torques (Nm, positive toward larger angles) for a glove with these joint angles (rad). They are full where the
  /// answer is up to kFullForce old, and zero from kForceless on. Zero for angles that are not finite. Cost: O(rows ·
  /// joints), 0.05 µs a row.
  const hands::JointValues& update(const hands::JointValues& angles, const HandAnswer& hand,
                                   std::chrono::nanoseconds age = std::chrono::nanoseconds(0)) noexcept;

 private:
  FingerHand hand_;
  devices::DeviceDescriptor device_;
  std::chrono::nanoseconds period_;
  double stiffness_;
  hands::JointValues lags_{};    // rad, from the visible hand to the glove
  hands::JointValues depths_{};  // rad, by which the lag of a joint goes into contacts
  hands::JointValues torques_{};
};

/// What `FingerForces` has to know of a hand of a simulation. Allocates.
HandAnswer answer_of(const grasping::GraspSimulation& simulation, std::size_t hand);

/// Thumb, index, middle, ring and little finger.
inline constexpr std::size_t kFingers = 5;

/// How hard the tips of a hand's fingers press, for a wearer whose fingers are at their targets. The springs of the
/// glove give the torques of the joints. The forces of the contacts are those, none of which pulls, whose torques come
/// nearest to them. The load of a held part is not in them. Not thread-safe.
class FingertipForces {
 public:
  /// Throws as `FingerForces` does.
  FingertipForces(const FingerHand& hand, const devices::DeviceDescriptor& device) : springs_(hand, device) {}

  /// N, for each finger the sum of the contacts of its last segment. `targets` are the angles (rad) to which the wearer
  /// closes the hand. Cost: O(rows · joints), a hundred times.
  std::array<double, kFingers> update(const hands::JointValues& targets, const HandAnswer& hand);

 private:
  FingerForces springs_;
};

}  // namespace glissade::haptics

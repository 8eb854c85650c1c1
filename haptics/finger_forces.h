#pragma once

/// The torques on the fingers in a glove. Where an object stops a joint of the visible hand, a spring pulls the joint
/// of the wearer's hand toward the visible one.

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

namespace glissade::grasping {
class GraspSimulation;
struct HandModel;
}  // namespace glissade::grasping

namespace glissade::haptics {

/// A hinge between the hand root and the palm. Frame P is the frame J of the previous hinge or, for the first hinge,
/// the hand root. Frame J turns about `axis_J`.
struct WristJoint {
  std::size_t angle = 0;  ///< number of the glove's joint
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis_J = Eigen::Vector3d::UnitX();  ///< of unit length
};

/// The kernel's data of a simulated hand with fingers.
struct FingerHand {
  hands::JointValues lower{};  ///< range of each joint, rad
  hands::JointValues upper{};
  std::vector<WristJoint> wrist{};  ///< in order from the hand root; a part in the hand moves with the last frame J
};

/// The `FingerHand` of a hand of the simulation.
GLISSADE_EXPORT FingerHand finger_hand(const grasping::HandModel& hand);

/// The stiffness (Nm/rad) of the spring at each glove joint. At full stiffness, the spring reaches `max_joint_torque`
/// at a depth of 0.8 degrees, so a finger that presses with a smaller torque stops within this angle. Three bounds may
/// lower the stiffness. The first is the passive stiffness b / (T/2 + t_d), with the joint's damping b, the period T of
/// the loop (at least that of the device), and the delay t_d of device and link (`passive_stiffness`). If the glove
/// does not report its `joint_damping`, b is the smallest damping with which the full stiffness is passive if the link
/// adds no delay. The second is r / (6 rad/s), because a torque with a maximum rate of r Nm/s
/// (`devices::joint_torque_rate`) lags behind a quickly tapping finger and would make it rattle. The third is twice the
/// joint's Coulomb friction divided by the step of the measured angles, because nothing damps a finger within a step.
/// Real-time safe.
GLISSADE_EXPORT double finger_stiffness(const devices::DeviceDescriptor& device, std::chrono::nanoseconds period,
                                        std::chrono::nanoseconds link_delay) noexcept;

/// `lags` (rad) are the joint angles of the glove minus those of the visible hand. If the lag of a joint closes the gap
/// of a contact, this joint must go back, at most to the visible hand. Computes, by least squares, how far (rad) all
/// such joints must go back until the contact opens, and raises `depths` to these angles. The torques of one contact
/// are the gradient of a convex energy in the closing joints. These joints together are no stiffer than each joint
/// alone, and softer if a lever arm is shorter than 2 mm. If a joint has several contacts, the greatest depth counts,
/// so n joints may be stiffer by the factor (1 + √n) / 2. Real-time safe: O(joints²) at worst.
GLISSADE_EXPORT void deepen(const FingerRow& row, const hands::JointValues& lags, hands::JointValues& depths) noexcept;

/// Computes the joint torques of a glove whose hand clasps an object. A spring pushes a joint
/// back if moving it from the visible hand's angle to the glove's angle leads deeper into a contact. The deflection of
/// the spring is the depth that `deepen` computes. All other joints get exactly zero torque.
///
/// The torque is continuous in the posture of the glove. Contacts whose lever arm about a joint's axis is less than 2
/// mm count less, down to zero. If a joint of the wearer presses with τ Nm (at most the largest torque), it rests τ /
/// stiffness (rad) deeper than the visible hand.
///
/// There is no damper, because gloves measure no rates, only angles, often in coarse steps. The bounds of the stiffness
/// take this into account.
///
/// Not thread-safe. Real-time safe: no allocation, no lock, no system call.
class GLISSADE_EXPORT FingerForces {
 public:
  /// Joints that the device does not have get no torque. Throws what `devices::validate` and `validate_tick_period`
  /// throw. Also throws std::invalid_argument if a limit of the hand is NaN, or if a lower limit exceeds the
  /// upper limit.
  FingerForces(const FingerHand& hand, const devices::DeviceDescriptor& device,
               std::chrono::nanoseconds period = kTickPeriod);

  /// From now on, limits the stiffness according to the delay of the link, measured at the glove
  /// (`GloveState::link_delay`).
  void set_link_delay(std::chrono::nanoseconds delay) noexcept;

  /// The present stiffness, Nm/rad.
  double stiffness() const noexcept { return stiffness_; }
  /// The largest joint torque of the device, Nm.
  double max_torque() const noexcept { return device_.max_joint_torque; }

  /// The torques (Nm, positive toward larger angles) for a glove with these joint angles (rad). The torques are full
  /// while the answer is younger than kFullForce, and zero from the age kForceless on. They are also zero for angles
  /// that are not finite. Cost: O(rows · joints), 0.05 µs a row.
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

/// The input of `FingerForces` from a hand of a simulation. Allocates.
GLISSADE_EXPORT HandAnswer answer_of(const grasping::GraspSimulation& simulation, std::size_t hand);

/// Thumb, index, middle, ring and little finger.
inline constexpr std::size_t kFingers = 5;

/// The forces of a hand's fingertips, for a wearer whose fingers are at their targets. The springs of the glove give
/// the joint torques. The result has the non-negative contact forces whose torques come nearest to these joint torques.
/// The load of a held part is not included. Not thread-safe.
class GLISSADE_EXPORT FingertipForces {
 public:
  /// Throws what the constructor of `FingerForces` throws.
  FingertipForces(const FingerHand& hand, const devices::DeviceDescriptor& device) : springs_(hand, device) {}

  /// For each finger, the sum (N) of the contact forces on its last segment. `targets` are the angles (rad) to which
  /// the wearer closes the hand. Cost: 100 iterations of O(rows · joints).
  std::array<double, kFingers> update(const hands::JointValues& targets, const HandAnswer& hand);

 private:
  FingerForces springs_;
};

}  // namespace glissade::haptics

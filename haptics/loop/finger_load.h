#pragma once

/// The load of a held part on the fingers: what the part's contacts exert on the hand, shared over the segments that
/// hold it.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/contact/spring.h>
#include <glissade/devices/glove_device.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

#include "loop/loop_settings.h"

namespace glissade::haptics {

/// The part presses on each segment along the normal of their contact, and never pulls. Of all such forces, those are
/// taken that come nearest to the load together and are small. A finger on the side to which a wall presses the part
/// feels it; what no contact can carry, no finger feels.
///
/// The torques follow the load within 30 ms, and are exactly zero where there has been no load or no contact for so
/// long. They may open a finger, but not take it off the part: they fade as the glove's segment leaves, and are
/// zero 1.2 mm off. There they follow the finger within 2 ms. So they are a spring, which must be passive too: the
/// force of a contact is limited so that this spring, against all joints together, is no stiffer than the finger's own
/// (`finger_stiffness`). Behind a link that leaves little. At most half of the device's largest torque.
///
/// The torques do not depend on posture alone, so their energy is counted. The account begins with 20 mJ. It grows by
/// what the fingers put in, and by 5 mW, to 40 mJ at most, and pays for what the torques give. The torques fade before
/// it is empty. A motion that is seen was made under the torques that the device had then.
///
/// Real-time safe: bounded work, no allocation. Not thread-safe.
class FingerLoad {
 public:
  /// `moves_part` are the numbers of the joints that move the palm, and the held part with it: the arm feels what
  /// they would. They get no torque, nor do those that the device does not have.
  FingerLoad(const devices::DeviceDescriptor& device, std::span<const std::size_t> moves_part,
             std::chrono::nanoseconds period = kTickPeriod);

  /// What acts on a hand. The load is the wrench on it about the world point `p_Wref`; the part has the number `part`,
  /// and no point of it is farther from there than `radius` (metres); −1: the hand holds none.
  struct Load {
    std::int32_t part = -1;
    contact::Wrench wrench;
    Eigen::Vector3d p_Wref = Eigen::Vector3d::Zero();
    double radius = 0.0;
  };

  /// From now on the torques come `delay` (seconds) after the motion that they answer, and a joint's spring may be as
  /// stiff as `stiffness` (Nm/rad).
  void set_link(double delay, double stiffness) noexcept {
    delay_s_ = delay;
    stiffness_ = stiffness;
  }

  /// The torques (Nm, positive toward larger angles) `dt` (seconds) after the last call, beside the torques of the
  /// `springs`: the sum stays within the device's limits. `angles` are those of the glove (rad).
  const hands::JointValues& update(const HandAnswer& hand, const Load& load, const hands::JointValues& springs,
                                   const hands::JointValues& angles, double dt) noexcept;

  /// J: what the torques may still give.
  double energy() const noexcept { return energy_; }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  void share(const HandAnswer& hand, const Load& load) noexcept;
  void follow(const HandAnswer& hand, const hands::JointValues& angles, double dt) noexcept;
  void count_energy(const hands::JointValues& angles, double dt) noexcept;

  /// Ticks: at 5 kHz 0.1 s of delay and 0.1 s without a state. A longer delay leaves next to no load.
  static constexpr std::size_t kGiven = 1024;

  double max_torque_;  // Nm
  double stiffness_;
  double period_s_;
  double delay_s_ = 0.0;
  std::array<bool, hands::kJoints> bears_;          // a load
  std::array<Vector6, kMaxFingerRows> directions_;  // of the forces: force, and torque by the radius
  std::array<double, kMaxFingerRows> forces_{};     // N
  hands::JointValues borne_{};                      // Nm: on segments that are on the part
  hands::JointValues fading_{};                     // share that is left of it where they leave
  hands::JointValues torques_{};
  std::vector<hands::JointValues> given_;  // a ring: the torques of the last ticks
  std::size_t newest_ = 0;
  hands::JointValues last_angles_{};
  bool has_angles_ = false;
  double unseen_s_ = 0.0;  // since the angles last changed
  double energy_ = kLoop.load_start_J;
};

}  // namespace glissade::haptics

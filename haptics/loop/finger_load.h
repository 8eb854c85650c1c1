#pragma once

/// The load of a held part on the fingers: what the part's contacts exert on the hand, shared over the segments that
/// hold it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <glissade/contact/spring.h>
#include <glissade/devices/glove_device.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

namespace glissade::haptics {

/// The part presses on each segment along the normal of their contact, and never pulls. Of all such forces, those are
/// taken that come nearest to the load together and are small. A finger on the side to which a wall presses the part
/// feels it; what no contact can carry, no finger feels.
///
/// The torques follow the load within 30 ms, and are exactly zero after that where there is no load or no contact.
/// They may open a finger, but not take it off the part: they fade as the glove's segment leaves, and are zero 1.2 mm
/// off. At most half of the device's largest torque. They do not depend on posture alone, so their energy is counted.
/// The account begins with 20 mJ. It grows by what the fingers put in, and by 1 mW, to 40 mJ at most, and pays for what
/// the torques give. The torques fade before it is empty.
///
/// Real-time safe: bounded work, no allocation. Not thread-safe.
class FingerLoad {
 public:
  /// `moves_part` are the numbers of the joints that move the palm, and the held part with it: the arm feels what
  /// they would. They get no torque, nor do those that the device does not have.
  FingerLoad(const devices::DeviceDescriptor& device, std::span<const std::size_t> moves_part);

  /// The torques (Nm, positive toward larger angles) `dt` (seconds) after the last call. The load is the wrench on the
  /// hand about the world point `p_Wref`; the part has the number `part`, and no point of it is farther from there than
  /// `radius` (metres); −1: the hand holds none. `angles` are those of the glove (rad).
  const devices::JointValues& update(const HandAnswer& hand, std::int32_t part, const contact::Wrench& load,
                                     const Eigen::Vector3d& p_Wref, double radius, const devices::JointValues& angles,
                                     double dt) noexcept;

  /// J: what the torques may still give.
  double energy() const noexcept { return energy_; }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  void share(const HandAnswer& hand, std::int32_t part, const contact::Wrench& load, const Eigen::Vector3d& p_Wref,
             double radius, const devices::JointValues& angles) noexcept;
  void count_energy(const devices::JointValues& angles, double dt) noexcept;

  static constexpr double kStart_J = 20e-3;

  double max_torque_;                               // Nm
  std::array<bool, devices::kGloveJoints> bears_;   // a load
  std::array<Vector6, kMaxFingerRows> directions_;  // of the forces: force, and torque by the radius
  std::array<double, kMaxFingerRows> forces_{};     // N
  devices::JointValues wanted_{};
  devices::JointValues torques_{};
  devices::JointValues last_angles_{};
  bool has_angles_ = false;
  double energy_ = kStart_J;
};

}  // namespace glissade::haptics

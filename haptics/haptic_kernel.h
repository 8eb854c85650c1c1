#pragma once

/// One tick of the haptic thread as a pure function of its inputs: glove state and contact set in, glove command out.
/// Owns no clock, no thread and no device, so the same code runs in real time, offline and in tests.

#include <Eigen/Geometry>

#include <glissade/devices/glove_types.h>
#include <glissade/devices/safety_limits.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/proxy.h>

namespace glissade::haptics {

/// What ties the hand to the part.
struct Coupling {
  CouplingStiffness stiffness;
  CouplingDamping damping;
};

/// The coupling a device can render without shaking: `wanted` cut to the limits of its descriptor, with a damping of
/// 5 ms times the stiffness; that against translation is cut to the descriptor's too. Throws std::invalid_argument,
/// naming the device, when it cannot render any stiffness against translation or rotation.
Coupling coupling_for(const devices::DeviceDescriptor& device, const CouplingStiffness& wanted);

/// What one tick computed.
struct HapticTick {
  Eigen::Isometry3d X_WG;         ///< ghost
  Eigen::Isometry3d X_WP;         ///< proxy
  Wrench spring;                  ///< on the hand about the ghost's reference point, before the device's limits
  devices::GloveCommand command;  ///< about the hand root, within the device's limits
  devices::LimitReasons limited;
};

/// Real-time safe: bounded work, no allocation, no lock, no system call. Not thread-safe.
class HapticKernel {
 public:
  /// The hand grasps the part rigidly, and the part is at X_WV_start when the first state comes.
  HapticKernel(const SlidingPart& part_V, const Coupling& coupling, const devices::DeviceDescriptor& device,
               const Eigen::Isometry3d& X_WV_start);

  /// The tick for the newest state and the newest contact set. A hand pose that is not finite gives no force and leaves
  /// the ghost where it was.
  HapticTick tick(const devices::GloveState& state, const ContactSet& set) noexcept;

 private:
  HapticTick no_force(const devices::GloveState& state) noexcept;

  Eigen::Vector3d p_Vref_;
  Coupling coupling_;
  devices::DeviceDescriptor device_;
  Eigen::Isometry3d X_WV_start_;
  Eigen::Isometry3d X_HG_ = Eigen::Isometry3d::Identity();  // the grasp, fixed by the first state
  bool grasped_ = false;
  Eigen::Isometry3d X_WG_;  // the last ghost
  Proxy proxy_;
  std::int64_t sequence_ = 0;
};

}  // namespace glissade::haptics

#pragma once

/// One tick of the haptic thread: device state and contact set (the simulation's newest answer) in, device
/// command out. The kernel owns no clock, no thread and no device, so the same code runs in real time, offline and in
/// tests.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Geometry>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

namespace glissade::haptics {

class ContactForce;
class SlidingPart;

/// The outcome of one tick.
struct HapticTick {
  Eigen::Isometry3d X_WG;        ///< ghost: the part's pose if nothing were in the way
  Wrench contacts;               ///< wrench of the contacts on the hand about the ghost's reference point
  double contact_share;          ///< of the force of the contacts: less than 1 where they are old or were left
  bool is_unsolved;              ///< the contacts have no solution, so their wrench goes towards zero
  devices::SafeCommand command;  ///< wrench of contacts and damper about the hand root, through the safety envelope
};

/// Real-time safe: bounded work, no allocation, no lock, no system call after construction. Not thread-safe.
class HapticKernel {
 public:
  /// At the first state with a finite hand pose, the ghost is at X_WV_start; from then on, the ghost moves rigidly with
  /// the hand. `stiffness` is the stiffness of the simulation (`SlidingSimulation::stiffness`). The kernel's coupling
  /// is the result of `coupling_for` with `device`, `stiffness` and `period`, the usual time between two ticks. If the
  /// simulation is stiffer than the device allows, the contact forces that the simulation reports differ from the force
  /// on the hand. To avoid this, construct the simulation with the stiffness that `coupling_for` returns. Throws as
  /// `coupling_for` does.
  HapticKernel(const SlidingPart& part_V, const CouplingStiffness& stiffness, const devices::DeviceDescriptor& device,
               const Eigen::Isometry3d& X_WV_start, std::chrono::nanoseconds period = kTickPeriod);
  ~HapticKernel();
  HapticKernel(const HapticKernel&) = delete;
  HapticKernel& operator=(const HapticKernel&) = delete;

  /// Computes the tick at time `now` for the newest state and the newest contact set. `now` is on the clock of
  /// `ContactSet::time`, and never goes back. A hand pose that is not finite leaves the ghost unchanged, and the force
  /// fades.
  HapticTick tick(const devices::GloveState& state, const ContactSet& set, std::chrono::nanoseconds now) noexcept;

  /// Emergency stop: the force fades to zero and stays there.
  void stop() noexcept { envelope_.stop(); }

  /// The coupling without delay of the link.
  const Coupling& coupling() const noexcept { return coupling_; }
  /// The coupling of the last tick: with the delay that the glove tells (`GloveState::link_delay`), smoothed over 0.1
  /// s.
  const Coupling& present_coupling() const noexcept { return present_; }

 private:
  double seconds_since_last_tick(std::chrono::nanoseconds now) noexcept;
  double soften(std::chrono::nanoseconds link_delay, double dt) noexcept;

  Eigen::Vector3d p_Vref_;
  std::chrono::nanoseconds period_;
  Coupling coupling_;
  Coupling present_;
  double link_delay_s_ = 0.0;
  devices::SafetyEnvelope envelope_;
  Eigen::Isometry3d X_WV_start_;
  Eigen::Isometry3d X_HG_ = Eigen::Isometry3d::Identity();  // the grasp, fixed by the first state
  bool grasped_ = false;
  Eigen::Isometry3d X_WG_;  // the last ghost
  std::unique_ptr<ContactForce> contacts_;
  std::optional<std::chrono::nanoseconds> last_tick_;
  std::int64_t sequence_ = 0;
};

}  // namespace glissade::haptics

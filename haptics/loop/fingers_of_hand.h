#pragma once

/// The fingers of a hand in the haptic loop: its palm, what its joints feel, and what the simulation is to know of it.

#include <chrono>
#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>
#include <glissade/devices/glove_device.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/finger_forces.h>

#include "loop/finger_load.h"
#include "loop/limits_of_hand.h"

namespace glissade::haptics {

/// Real-time safe after construction. Not thread-safe.
class FingersOfHand {
 public:
  /// Throws std::invalid_argument as `FingerForces` does, and for joints of a wrist that are none.
  FingersOfHand(const FingerHand& hand, const devices::DeviceDescriptor& device, std::chrono::nanoseconds period);

  /// Whether the angles of a state are numbers.
  static bool have_angles(const devices::GloveState& state) noexcept;
  /// Moves the palm with the state, `dt` (seconds) after the last. The joints of the wrist turn no faster than a hand
  /// can, whatever their sensors say.
  void move_palm(const devices::GloveState& state, double dt) noexcept;
  /// The palm P, with which a held part moves.
  const Eigen::Isometry3d& X_WP() const { return X_WP_; }

  /// Whether this decision (`HandAnswer::decision`) is another than in the last call.
  bool is_new(std::int64_t decision) noexcept;

  void set_link_delay(std::chrono::nanoseconds delay) noexcept;
  /// Whether the glove takes limits of its joints instead of torques.
  bool takes_limits() const noexcept { return device_.finger_command != devices::FingerCommand::kTorque; }
  /// Limits whose torques fade with the age of the answer as those of springs do, and return within 200 ms.
  devices::JointLimits limits(const HandAnswer& answer, std::chrono::nanoseconds age, double dt) noexcept;
  /// Torques (Nm) of the springs at the joints, and of the load of the held part.
  hands::JointValues torques(const devices::GloveState& state, const HandAnswer& answer, std::chrono::nanoseconds age,
                             const FingerLoad::Load& load, double dt) noexcept;

  /// Notes the newest state if it can be trusted, or null, and the part that the hand holds.
  void note(const devices::GloveState* seen, std::optional<std::size_t> part, double dt) noexcept;
  /// A hand whose states stay away for a moment is where it was last.
  const GhostOfHand& ghost() const { return ghost_; }

 private:
  FingerHand hand_;
  FingerForces forces_;
  FingerLoad load_;
  devices::DeviceDescriptor device_;
  double limits_share_ = 1.0;    // of the largest torque
  hands::JointValues angles_{};  // of the wrist, as the ghost has them
  bool is_found_ = false;        // the angles are those of a state
  std::int64_t decision_ = 0;
  GhostOfHand ghost_;
  std::optional<std::chrono::nanoseconds> time_seen_;  // of the last state that could be trusted
  double unseen_s_ = 0.0;                              // since it came
  Eigen::Isometry3d X_WP_ = Eigen::Isometry3d::Identity();
};

}  // namespace glissade::haptics

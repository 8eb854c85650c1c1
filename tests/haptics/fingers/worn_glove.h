#pragma once

/// A wearer in a simulated glove whose fingers clasp one object and feel it: the loop from glove to clasp to torques to
/// envelope and back, a millisecond a step.

#include <chrono>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/finger_forces.h>

#include "clasped_hand.h"
#include "loop/finger_rows.h"

namespace glissade::test_support {

class WornGlove {
 public:
  /// The wearer's open hand, at `script_X_WR`, closes to `fist` and opens again at these times.
  WornGlove(const geometry::TriangleMesh& object, const Eigen::Isometry3d& X_WB, geometry::PoseTrajectory script_X_WR,
            const grasping::Posture& fist, std::vector<std::chrono::nanoseconds> grip_changes);

  ClaspedHand hand;

  /// One millisecond.
  void step();
  void run(int milliseconds);
  /// The next so many milliseconds, the glove's tracker sees nothing: all its numbers are NaN.
  void lose_tracking(int milliseconds) { lost_for_ = milliseconds; }

  const devices::GloveState& state() const { return glove_.state(); }
  const devices::DeviceDescriptor& descriptor() const { return glove_.descriptor(); }
  double stiffness() const { return forces_.stiffness(); }
  /// The command of the last step, and what `FingerForces` wanted.
  const devices::SafeCommand& command() const { return command_; }
  const hands::JointValues& wanted() const { return wanted_; }
  /// J: what the fingers have put into the glove so far, against its torques and the friction of its joints.
  double energy() const { return energy_; }

 private:
  devices::SimulatedGlove glove_;
  haptics::FingerForces forces_;
  devices::SafetyEnvelope envelope_;
  devices::SafeCommand command_;
  hands::JointValues wanted_{};
  haptics::HandAnswer answer_;
  haptics::FingerRows rows_;
  double energy_ = 0.0;
  int lost_for_ = 0;
  int silent_for_ = 0;  // ms without a target
};

}  // namespace glissade::test_support

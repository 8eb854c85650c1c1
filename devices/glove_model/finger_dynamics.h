#pragma once

/// The fingers of a wearer in a device: 22 joints, each by itself, without gravity and without coupling between joints.

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include <glissade/devices/glove_model.h>
#include <glissade/hands/hand.h>

#include "glove_model/finger_actuators.h"
#include "glove_model/finger_joint.h"
#include "glove_model/finger_wearer.h"

namespace glissade::devices {

/// The length of a step of integration: 8 kHz.
inline constexpr std::chrono::nanoseconds kFingerStep = std::chrono::microseconds(125);

/// Deterministic: the same inputs give the same bits. Allocates only at construction.
class FingerDynamics {
 public:
  /// Starts at rest at `angles` (rad). The model must be valid.
  FingerDynamics(const GloveModel& model, const hands::JointValues& angles);

  /// Advances by `dt` in steps of `kFingerStep`; a rest is left to the next call. `aims` are the intended angles (rad),
  /// `is_closed` says whether the hand grips.
  void advance(std::chrono::nanoseconds dt, const hands::JointValues& aims, bool is_closed,
               const FingerOrder& order) noexcept;

  const hands::JointValues& angles() const noexcept { return angles_; }                    ///< rad
  const hands::JointValues& rates() const noexcept { return rates_; }                      ///< rad/s
  const hands::JointValues& actuator_angles() const noexcept { return actuator_angles_; }  ///< rad at the joints
  const hands::JointValues& actuator_rates() const noexcept { return actuator_rates_; }    ///< rad/s at the joints
  /// Torques of the device on the joints, Nm.
  const hands::JointValues& loads() const noexcept { return loads_; }
  /// Steps of integration so far.
  std::int64_t steps() const noexcept { return steps_; }

 private:
  void step(const hands::JointValues& aims, double grip, const FingerOrder& order) noexcept;

  GloveModel model_;
  FingerWearer wearer_;
  std::vector<FingerJoint> joints_;
  std::optional<FingerActuators> actuators_;
  std::optional<FingerStrings> strings_;
  hands::JointValues angles_;
  hands::JointValues rates_{};
  hands::JointValues actuator_angles_;
  hands::JointValues actuator_rates_{};
  hands::JointValues loads_{};
  std::chrono::nanoseconds rest_{0};
  std::int64_t steps_ = 0;
};

}  // namespace glissade::devices

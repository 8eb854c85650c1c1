#pragma once

/// A wearer closes a finger on something that stops it at an angle, with a glove that holds limits of its joints.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include <glissade/devices/glove_model.h>
#include <glissade/haptics/finger_forces.h>

#include "disturbed_loop.h"

namespace glissade::haptics {

class PressedFinger : public DisturbedWorld {
 public:
  static constexpr std::size_t kJoint = 4;  ///< that bends the finger
  static constexpr double kArm_m = 0.08;    ///< of the contact
  static constexpr double kStop_rad = 0.6;

  devices::SimulatedGlove& glove() override { return glove_; }
  HapticKernel& kernel() override { return kernel_; }

  ContactSet at_start() override {
    ContactSet set;
    set.sequence = 1;
    show(0.0, set);
    return set;
  }

  /// The visible finger follows the glove up to the object.
  void answer(const Ghosts& ghosts, ContactSet& set) override {
    ++set.sequence;
    set.time = ghosts.time;
    show(std::min(ghosts.hands[0].angles[kJoint], kStop_rad), set);
  }

 private:
  static void show(double angle, ContactSet& set) {
    HandAnswer& hand = set.hands[0];
    hand.visible.angles[kJoint] = angle;
    hand.row_count = 1;
    hand.row_array[0] = {};
    hand.row_array[0].rates[kJoint] = -kArm_m;
    hand.row_array[0].gap = kArm_m * (kStop_rad - angle);
  }

  /// Without friction and backlash, so that the torque depends on the angle alone.
  static devices::GloveModel servo_glove() {
    devices::GloveModel glove;
    glove.name = "servo glove";
    glove.update_rate = 1000.0;
    glove.fingers = devices::FingerKind::kJointLimit;
    glove.wearer.tremor = 0.0;
    glove.wearer.reflex_gain = 0.0;
    glove.actuator.is_driven[kJoint] = true;
    glove.actuator.motor_torque = 0.5;
    glove.actuator.rotor_inertia = 1e-6;
    glove.actuator.viscous_friction = 0.02;
    glove.servo.max_stiffness = 5.0;
    return glove;
  }

  /// Closes within half a second, 0.4 rad too far, and then bends to and fro by 0.05 rad.
  static devices::SimulatedGloveParameters wearer() {
    using std::chrono::milliseconds;
    devices::SimulatedGloveParameters parameters;
    parameters.fingers.push_back({milliseconds(0), {}});
    for (int i = 1; i <= 20; ++i) {
      hands::JointValues angles{};
      angles[kJoint] = kStop_rad + 0.4 + (i % 2 == 0 ? 0.05 : -0.05);
      parameters.fingers.push_back({milliseconds(500 * i), angles});
    }
    return parameters;
  }

  static FingerHand hand() {
    FingerHand hand;
    hand.lower.fill(-1.5);
    hand.upper.fill(1.5);
    return hand;
  }

  devices::SimulatedGlove glove_{
      geometry::PoseTrajectory({{std::chrono::nanoseconds(0), Eigen::Isometry3d::Identity()}}), wearer(),
      servo_glove()};
  HapticKernel kernel_{{{Eigen::Vector3d::Zero(), 0.05, {1000.0, 2.0}}},
                       {{.device = glove_.descriptor(), .fingers = hand()}}};
};

}  // namespace glissade::haptics

#pragma once

/// A force-feedback glove without hardware: a hand on a grounded arm, moved by a wearer who follows a script but yields
/// to the forces the glove is sent. A pure kernel: no thread, no clock; the same inputs give the same bits.

#include <chrono>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/devices/glove_device.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::devices {

/// The glove and its wearer, SI. The wearer is a spring and damper toward the script, about as stiff as a relaxed to
/// lightly tensed arm and critically damped, so that a steady force F holds the hand F / stiffness away from the
/// script.
struct SimulatedGloveParameters {
  double mass = 0.8;                         ///< hand, forearm and arm of the device, as felt at the hand root; kg
  double rotational_inertia = 0.003;         ///< the same about every axis; kg m²
  double arm_damping = 2.0;                  ///< friction of the grounded arm; N s/m
  double arm_rotational_damping = 0.01;      ///< Nm s/rad
  double wearer_stiffness = 400.0;           ///< N/m
  double wearer_damping = 35.0;              ///< against the velocity of the script; N s/m
  double wearer_rotational_stiffness = 4.0;  ///< Nm/rad
  double wearer_rotational_damping = 0.22;   ///< Nm s/rad
  double finger_stiffness = 0.5;             ///< Nm/rad
  double finger_time_constant = 0.05;        ///< of a finger's way to its balance; s
  JointValues grasp_posture{};               ///< the angles the wearer holds; rad
};

/// 20 N, 1 Nm, 4000 N/m, 1 kHz: a grounded arm like the stronger published ones. Joint limits from the human hand.
DeviceDescriptor simulated_glove_descriptor();

/// Semi-implicit Euler in steps of at most 1 ms.
/// Thread-safety: none; step it in one thread. Nothing is allocated after construction.
class SimulatedGlove {
 public:
  /// Starts at rest at the first pose of the script, which is that of the hand root, X_WH. Throws
  /// std::invalid_argument, naming the parameter, when one is not finite, not positive (damping and posture may be 0),
  /// or so large that steps of 1 ms would not be stable.
  explicit SimulatedGlove(geometry::PoseTrajectory script_X_WH, const SimulatedGloveParameters& parameters = {});

  const DeviceDescriptor& descriptor() const noexcept { return descriptor_; }

  /// Sequence 0 at the first time of the script.
  const GloveState& state() const noexcept { return state_; }

  /// Lets `dt` pass under `newest`, the command that holds all the while, limited to the descriptor as a real device
  /// would; returns the new state, its sequence one higher and its time later by `dt`. Nothing moves for dt ≤ 0.
  GloveState step(std::chrono::nanoseconds dt, const GloveCommand& newest) noexcept;

 private:
  void move_hand(double h, const GloveCommand& command) noexcept;
  void turn_hand(double h, const GloveCommand& command) noexcept;
  void move_fingers(double h, const GloveCommand& command) noexcept;

  geometry::PoseTrajectory script_X_WH_;
  SimulatedGloveParameters parameters_;
  DeviceDescriptor descriptor_;
  GloveState state_;
  Eigen::Quaterniond q_WH_;
};

}  // namespace glissade::devices

#pragma once

/// A simulated force-feedback glove, i.e. the hand of a wearer on a grounded force-feedback arm. The wearer follows a
/// script, i.e. a given trajectory of the hand, but yields to the commanded forces. With a `GloveModel`, the device has
/// the mechanics, sensors and link of the model. The simulation has neither threads nor clocks: the same inputs give
/// bit-identical outputs.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::devices {

/// Viscous friction of the grounded arm, N s/m and Nm s/rad.
inline constexpr double kArmDamping = 2.0;
inline constexpr double kArmRotationalDamping = 0.01;

/// Viscous friction of each finger joint of the glove, Nm s/rad.
inline constexpr double kJointDamping = 0.02;

/// Joint angles (rad) at one time of the script.
struct TimedAngles {
  std::chrono::nanoseconds time{0};
  hands::JointValues angles{};
};

/// The angles at `time`: interpolated between two entries, constant before the first and after the last entry. `timed`
/// must have at least one entry, and ascending times. Cost O(log n).
GLISSADE_EXPORT hands::JointValues angles_at(const std::vector<TimedAngles>& timed,
                                             std::chrono::nanoseconds time) noexcept;

/// The glove and its wearer, in SI units. The wearer is a critically damped spring and damper between hand and script.
/// The stiffness is that of a relaxed to slightly tensed human arm. A steady force F displaces the hand from the script
/// by F / stiffness.
struct SimulatedGloveParameters {
  double mass = 0.8;                  ///< effective mass of hand, forearm and the device's arm at the hand root; kg
  double rotational_inertia = 0.003;  ///< inertia about every axis of the hand root; kg m²
  double arm_damping = kArmDamping;   ///< viscous friction of the grounded arm; N s/m
  double arm_rotational_damping = kArmRotationalDamping;  ///< Nm s/rad
  double wearer_stiffness = 400.0;                        ///< N/m
  double wearer_damping = 35.0;                           ///< damping of the velocity relative to the script; N s/m
  double wearer_rotational_stiffness = 4.0;               ///< Nm/rad
  double wearer_rotational_damping = 0.22;                ///< Nm s/rad
  double finger_stiffness = 0.5;                          ///< Nm/rad
  /// Time constant of a finger's approach to its equilibrium; s. `finger_stiffness` times this time is the viscous
  /// friction of glove and finger together.
  double finger_time_constant = 0.05;
  hands::JointValues grasp_posture{};  ///< joint angles to which the wearer's fingers return; rad
  /// Joint angles of the open hand. Without a value, the fingers stay where they are when the hand lets go.
  std::optional<hands::JointValues> open_posture{};
  /// Joint angles over the time of the script. If there are entries, they replace the grasp posture and the open
  /// posture. Otherwise, the grip selects one of the two postures.
  std::vector<TimedAngles> fingers{};
  std::chrono::nanoseconds frozen{0};  ///< `DeviceDescriptor::frozen`
  bool starts_closed = true;           ///< the hand is closed at the start of the script
  /// Times of the script, ascending, at which the hand closes or opens.
  std::vector<std::chrono::nanoseconds> grip_changes{};
};

/// Descriptor of the simulated glove, with the limits of stronger grounded arms in the literature: 20 N, 1 Nm, 4000 N/m
/// and 1000 updates per second. The joint limits are the limits of the human hand.
GLISSADE_EXPORT DeviceDescriptor simulated_glove_descriptor();

struct GloveModel;
struct LinkLosses;
class ModelledGlove;

/// Integrates by semi-implicit Euler in steps of at most 1 ms. Fingers of a model, and arms that hold half-spaces, are
/// integrated at 8 kHz. Allocates only at construction. Not thread-safe.
class GLISSADE_EXPORT SimulatedGlove {
 public:
  /// Starts at rest at the first pose of `script_X_WH`, the intended trajectory of the hand root. Throws
  /// std::invalid_argument, naming the parameter, in these cases: a number is not finite; a damping is negative; a
  /// parameter other than dampings and angles is not positive; stiffness or damping is too large for stable steps of 1
  /// ms; or the times of the fingers do not ascend.
  explicit SimulatedGlove(geometry::PoseTrajectory script_X_WH, const SimulatedGloveParameters& parameters = {});

  /// A device of this model. The model, not `parameters`, determines the damping of the arm and, if the fingers have
  /// dynamics, of the fingers. Throws what the other constructor throws, and what `validate` throws for the model.
  SimulatedGlove(geometry::PoseTrajectory script_X_WH, const SimulatedGloveParameters& parameters,
                 const GloveModel& model);

  SimulatedGlove(const SimulatedGlove& other);
  SimulatedGlove(SimulatedGlove&& other) noexcept;
  SimulatedGlove& operator=(SimulatedGlove other) noexcept;
  ~SimulatedGlove();

  const DeviceDescriptor& descriptor() const noexcept { return descriptor_; }

  /// The newest measured state. With a model, the newest state that has passed the link of the model. The initial state
  /// has sequence 0 and the first time of the script.
  const GloveState& state() const noexcept { return state_; }

  /// The true state of the hand, at the present time. Without a model, it is the measured state.
  const GloveState& true_state() const noexcept { return truth_; }

  /// How many messages the model's communication link has lost so far.
  LinkLosses link_losses() const noexcept;

  /// The torques (Nm) that the device exerts on the finger joints, at the present time.
  const hands::JointValues& felt_torques() const noexcept { return felt_torques_; }

  /// The time since the measurement of `state()`. 0 without a model.
  std::chrono::nanoseconds state_age() const noexcept { return truth_.time - state_.time; }

  /// Advances the simulation by `dt` under the command `newest`. Returns the new state, with a sequence higher by one
  /// and a time later by `dt`. For dt ≤ 0, only the sequence changes. Within a step, the command acts fully for three
  /// periods of the device and then fades within seven periods, as in a device with a watchdog against a late driver.
  /// (An envelope assumes that the command acts for 10 ms.) The wearer follows the script at `pace` times its speed,
  /// from 0 (the wearer waits) to 1.
  ///
  /// With a model, the device measures at its own rate, at the ends of steps, and takes a command after each
  /// measurement. The result is the newest state that has arrived, so sequence and time may stay the same. The time of
  /// a state is that of its measurement. A command acts from its arrival at the device. Limits of finger joints and
  /// half-spaces act until they expire.
  GloveState step(std::chrono::nanoseconds dt, const SafeCommand& newest, double pace = 1.0) noexcept;

  /// The wearer's present time in the script.
  std::chrono::nanoseconds script_time() const noexcept { return script_time_; }

 private:
  std::int64_t grip_at(std::chrono::nanoseconds time) const noexcept;
  hands::JointValues aim_of_fingers() const noexcept;
  double share_of_command(std::chrono::nanoseconds age) const noexcept;
  void move_hand(double h, double pace, const Eigen::Vector3d& f_H_W) noexcept;
  void turn_hand(double h, double pace, const Eigen::Vector3d& t_H_W) noexcept;
  void move_fingers(double h, double share, const hands::JointValues& torques) noexcept;
  void move_modelled_fingers(std::chrono::nanoseconds dt, std::chrono::nanoseconds age, double share,
                             const GloveCommand& command) noexcept;

  geometry::PoseTrajectory script_X_WH_;
  SimulatedGloveParameters parameters_;
  DeviceDescriptor descriptor_;
  GloveState truth_;
  GloveState state_;
  std::chrono::nanoseconds script_time_;
  Eigen::Quaterniond q_WH_;
  hands::JointValues felt_torques_{};
  std::unique_ptr<ModelledGlove> modelled_;  ///< null without a model
};

}  // namespace glissade::devices

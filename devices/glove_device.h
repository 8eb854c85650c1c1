#pragma once

/// A force-feedback glove in the haptic loop: its state, commands and limits, and the interface of a device driver.
/// A driver implements `GloveDevice`, the last class of this file, and reads `SafeCommand` (safety_envelope.h).
/// Frames: W world; H hand root, i.e. the frame whose pose the glove reports.

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/hands/hand.h>

namespace glissade::devices {

/// Reasons why the command for the device differs from the wanted command. The first seven let the force fade to zero.
struct LimitReasons {
  bool is_stopped = false;      ///< stopped for good by an emergency stop or by the end of the program
  bool is_disabled = false;     ///< the wearer does not hold the enable switch
  bool is_refused = false;      ///< the glove obeys another server
  bool not_finite = false;      ///< a number of the wanted command or of the state is NaN or infinite
  bool is_implausible = false;  ///< the newest or a recent state contradicts the descriptor or earlier states
  bool is_state_old = false;    ///< the newest state was measured too long ago
  bool is_command_old = false;  ///< the wanted command answers a state that is too old or does not exist
  bool is_returning = false;    ///< the force returns softly, after the start or after one of the reasons above
  bool force_limited = false;   ///< the force was scaled down to the device's maximum
  bool torque_limited = false;  ///< the torque was scaled down to the device's maximum
  bool joints_limited = false;  ///< at least one joint torque was clamped
  bool rate_limited = false;    ///< the change of force or torques was limited to the device's rates
  bool power_limited = false;   ///< the wrench was scaled down to the device's largest power
  bool mean_limited = false;    ///< the force was scaled down because its mean is near the device's largest mean
  bool energy_limited = false;  ///< the wrench was scaled down because too little energy is left

  /// Whether the force fades or has faded to zero.
  bool is_fading() const noexcept {
    return is_stopped || is_disabled || is_refused || not_finite || is_implausible || is_state_old || is_command_old;
  }
  bool any() const noexcept {
    return is_fading() || is_returning || force_limited || torque_limited || joints_limited || rate_limited ||
           power_limited || mean_limited || energy_limited;
  }
};

struct NamedReason {
  bool LimitReasons::*flag;
  std::string_view name;
};

/// All reasons, the most serious first. Messages carry the reasons as bits in this order.
inline constexpr std::array<NamedReason, 15> kLimitReasons{{{&LimitReasons::is_stopped, "stopped"},
                                                            {&LimitReasons::is_disabled, "disabled"},
                                                            {&LimitReasons::is_refused, "refused"},
                                                            {&LimitReasons::not_finite, "not-finite"},
                                                            {&LimitReasons::is_implausible, "implausible"},
                                                            {&LimitReasons::is_state_old, "state-old"},
                                                            {&LimitReasons::is_command_old, "command-old"},
                                                            {&LimitReasons::is_returning, "returning"},
                                                            {&LimitReasons::force_limited, "force"},
                                                            {&LimitReasons::torque_limited, "torque"},
                                                            {&LimitReasons::joints_limited, "joints"},
                                                            {&LimitReasons::rate_limited, "rate"},
                                                            {&LimitReasons::power_limited, "power"},
                                                            {&LimitReasons::mean_limited, "mean"},
                                                            {&LimitReasons::energy_limited, "energy"}}};

GLISSADE_EXPORT std::int32_t to_bits(const LimitReasons& reasons) noexcept;
/// Ignores bits without a meaning.
GLISSADE_EXPORT LimitReasons limit_reasons_from_bits(std::int32_t bits) noexcept;

/// The value (rad) of a limit that is absent. Beyond every joint's range, but finite, so that messages can carry it.
inline constexpr double kNoLimit_rad = 6.0;

/// A range of one joint's angle. The device holds the range in its own control loop, at its own rate. Beyond the range,
/// a spring and damper push back with at most `max_torque`, and never pull. Within the range, the joint is free. A
/// force over a slow link must be soft to be passive. A limit can be as stiff as the device's own loop permits, because
/// only the limit crosses the link.
struct JointLimit {
  double lower = -kNoLimit_rad;  ///< rad
  double upper = kNoLimit_rad;   ///< rad
  double stiffness = 0.0;        ///< Nm/rad
  double damping = 0.0;          ///< Nm s/rad
  double max_torque = 0.0;       ///< Nm; 0: there is no limit

  bool operator==(const JointLimit&) const = default;
};

/// The torque (Nm, positive toward larger angles) of a limit on a joint with this angle (rad) and rate (rad/s).
GLISSADE_EXPORT double limit_torque(const JointLimit& limit, double angle, double rate) noexcept;

/// The energy (J) that the spring of a limit stores while the joint is at this angle (rad).
GLISSADE_EXPORT double stored_energy(const JointLimit& limit, double angle) noexcept;

/// One limit per joint, in the order of `hands::kJointNames`.
struct JointLimits {
  std::array<JointLimit, hands::kJoints> joints{};
  /// A device that receives nothing for this time drops all limits. The envelope sets it by the rate of the device.
  std::chrono::nanoseconds expiry{std::chrono::milliseconds(10)};

  bool operator==(const JointLimits&) const = default;
  bool any() const noexcept {
    for (const JointLimit& joint : joints) {
      if (joint.max_torque > 0.0) return true;
    }
    return false;
  }
};

/// One of several joints that turn together. It turns by its `way` (rad, either sign) while the others turn by theirs.
struct JointWay {
  std::size_t joint;  ///< index in `hands::kJointNames`
  double way;
};

/// The fraction of their ways by which these joints, now at `angles` (rad), can turn together until a contact stops
/// them. A joint's limit is the angle at which the joint, turning alone, would close the contact. Together, the joints
/// close it earlier: when the covered fractions of their distances to the limits add up to 1. The result is not
/// positive if a joint is at or beyond its limit, and infinite without limits.
GLISSADE_EXPORT double way_left(std::span<const JointWay> joints, const JointLimits& limits,
                                const hands::JointValues& angles) noexcept;

/// Largest number of half-spaces in a command. At most six push at once. The other two may push next.
inline constexpr std::size_t kMaxHalfSpaces = 8;

/// The constraint n·(v + w × r) ≥ bound on a displacement of the hand: the translation v (metres) of its reference
/// point R, and the rotation vector w (rad) about R. A half-space stands for one contact of the part in the hand.
struct HalfSpace {
  Eigen::Vector3d n_W = Eigen::Vector3d::Zero();  ///< unit normal, from the obstacle to the part
  Eigen::Vector3d r_W = Eigen::Vector3d::Zero();  ///< from R to the contact point, metres
  double bound = 0.0;                             ///< metres; negative: the contact is still open
};

/// Half-spaces in which the device keeps the displacement of the hand from the pose X_WB, in its own control loop, at
/// its own rate. If the displacement leaves a half-space, a spring and damper push the hand toward the displacement
/// that satisfies all half-spaces and is nearest in the metric of the spring. They never pull. However many contacts
/// push, the stiffness never exceeds that of the spring. The half-spaces are exact for translations only: after a
/// rotation by an angle a (rad), a contact at the distance r from R is off by up to r a² / 2.
struct HalfSpaces {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  Eigen::Vector3d p_HR = Eigen::Vector3d::Zero();  ///< R in the frame of the hand, metres
  std::array<HalfSpace, kMaxHalfSpaces> rows{};
  std::size_t count = 0;              ///< rows in use
  double stiffness = 0.0;             ///< against translation of R, N/m
  double rotational_stiffness = 0.0;  ///< against rotation about R, Nm/rad
  double damping = 0.0;               ///< N s/m; against rotation: times rotational_stiffness / stiffness
  /// Largest size of the wrench about R, N. The size is √(f² + t² K / K_r), with the two stiffnesses K and K_r.
  double max_force = 0.0;
  double max_torque = 0.0;  ///< largest torque about the hand root, Nm; 0 for a device without torque
  /// A device that receives nothing for this time drops all half-spaces. The envelope sets it by the device's rate.
  std::chrono::nanoseconds expiry{std::chrono::milliseconds(10)};

  bool any() const noexcept { return count > 0 && stiffness > 0.0 && rotational_stiffness > 0.0 && max_force > 0.0; }
};

/// Force (N) and torque (Nm, about the origin of H) on the hand, in world axes.
struct HandWrench {
  Eigen::Vector3d f_H_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d t_H_W = Eigen::Vector3d::Zero();
};

/// The wrench that half-spaces exert on a hand: its pose, the velocity of the origin of H (m/s), angular velocity
/// (rad/s). Zero for half-spaces that contradict each other. Cost: about ten microseconds for eight rows. Real-time
/// safe.
GLISSADE_EXPORT HandWrench half_space_wrench(const HalfSpaces& half_spaces, const Eigen::Isometry3d& X_WH,
                                             const Eigen::Vector3d& v_WH = Eigen::Vector3d::Zero(),
                                             const Eigen::Vector3d& w_WH = Eigen::Vector3d::Zero()) noexcept;

/// The energy (J) that the spring of the half-spaces stores with the hand at this pose.
GLISSADE_EXPORT double stored_energy(const HalfSpaces& half_spaces, const Eigen::Isometry3d& X_WH) noexcept;

/// Measured state of the hand in a glove, in SI units.
struct GloveState {
  std::int64_t sequence = 0;         ///< ≥ 0, increases with every state
  std::chrono::nanoseconds time{0};  ///< time of the measurement, on the glove's clock
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_WH = Eigen::Vector3d::Zero();  ///< velocity of the origin of H, in world axes; m/s
  Eigen::Vector3d w_WH = Eigen::Vector3d::Zero();  ///< angular velocity of H, in world axes; rad/s
  hands::JointValues joint_angles{};
  /// Number of times that the hand has closed or opened so far: odd while the hand is closed. The count stays correct
  /// when states are lost. A driver that does not detect the grip leaves it at 1.
  std::int64_t grip = 1;
  bool obeys_another = false;  ///< the glove obeys another server, and ignores the commands of this one
  bool is_enabled = true;      ///< false if the glove has an enable switch and the wearer does not hold it
  /// `limits` has the reasons why the envelope at the glove limited the last command. `command_age` is the time since
  /// the measurement of the state that this command answers, i.e. the time of the whole round trip. For a glove in the
  /// same process, `limits` is empty and `command_age` is 0.
  LimitReasons limits;
  std::chrono::nanoseconds command_age{0};
  /// `SafetyEnvelope::link_delay` at the glove. 0: no envelope at the glove limits the energy, so the server's does.
  std::chrono::nanoseconds link_delay{0};
  double energy = 0.0;  ///< `SafeCommand::energy` of the last command, J
  /// `SafeCommand::taken` of the last command, J; no value for a glove in the same process.
  std::optional<double> taken{};
};

/// Forces (N) and torques (Nm) wanted from the glove, zero by default. A command answers the state from which it was
/// computed. Devices do not take a `GloveCommand`: `SafetyEnvelope` turns it into a `SafeCommand`.
struct GloveCommand {
  std::int64_t session = 0;                         ///< session of the sender, set by the receiver; 0 without a link
  std::int64_t sequence = 0;                        ///< ≥ 0, increases with every command
  std::int64_t state_sequence = 0;                  ///< `GloveState::sequence` of the state that the command answers
  std::chrono::nanoseconds state_time{0};           ///< `GloveState::time` of this state, on the glove's clock
  std::chrono::nanoseconds time{0};                 ///< time of the computation, on the sender's clock
  Eigen::Vector3d f_H_W = Eigen::Vector3d::Zero();  ///< force on the hand at the origin of H, in world axes
  Eigen::Vector3d t_H_W = Eigen::Vector3d::Zero();  ///< torque on the hand about the origin of H, in world axes
  hands::JointValues joint_torques{};               ///< positive toward larger joint angles
  JointLimits joint_limits{};                       ///< only for devices that take limits, see `FingerCommand`
  HalfSpaces half_spaces{};                         ///< only for devices that take half-spaces, see `ToolCommand`
  /// Total energy (J) that independently moving bodies, such as a part in another hand, have given to this hand so far,
  /// minus the energy that they have requested back, plus the hand's work against withheld force. When `supply` rises,
  /// force and torque are allowed to give the hand the same amount of energy. When `supply` falls, the hand gives up as
  /// much of the difference as it can spare (`GloveState::taken`).
  double supply = 0.0;

  /// Whether no force, no limit and no half-space acts.
  bool is_at_rest() const noexcept {
    return f_H_W.isZero(0.0) && t_H_W.isZero(0.0) && joint_torques == hands::JointValues{} && !joint_limits.any() &&
           !half_spaces.any();
  }
};

/// The kind of command that the fingers of a device take. Messages carry the number of the kind.
enum class FingerCommand : std::int32_t {
  kTorque = 0,      ///< a torque for each joint
  kJointLimit = 1,  ///< a limit for each joint, which the device holds in its own loop
  kCurlLimit = 2,   ///< a limit for the flexion of each finger; the driver derives it from joint limits
  kBrake = 3,       ///< a resistance for each finger; the driver derives it from joint limits
};

/// Number of kinds; their values run from 0 to kFingerCommands − 1.
inline constexpr std::int32_t kFingerCommands = 4;

/// The kind of command that the hand root of a device takes. Messages carry the number of the kind.
enum class ToolCommand : std::int32_t {
  kWrench = 0,      ///< a force and a torque
  kHalfSpaces = 1,  ///< half-spaces instead of a wrench; the device holds them in its own loop
};

/// Number of kinds; their values run from 0 to kToolCommands − 1.
inline constexpr std::int32_t kToolCommands = 2;

/// Capabilities and limits of a device, in SI units: N, Nm, W, N/m, Nm/rad, N s/m, Nm s/rad, rad, m, s, Hz. Required:
/// `max_force`, `max_torque`, `max_stiffness` and `max_rotational_stiffness`. By default, the hand feels nothing.
struct DeviceDescriptor {
  std::string name;
  double max_force = 0.0;                 ///< largest norm of the force on the hand
  double max_torque = 0.0;                ///< largest norm of the torque on the hand
  double max_stiffness = 0.0;             ///< largest translational stiffness rendered without shaking
  double max_rotational_stiffness = 0.0;  ///< largest rotational stiffness rendered without shaking
  double max_damping = 0.0;               ///< largest translational damping rendered without shaking
  double max_joint_torque = 0.0;          ///< largest torque of each joint
  /// The properties of the bare device, without commanded forces and without a hand. They determine the stiffness that
  /// the device can render passively (`passive_stiffness`, `finger_stiffness`). 0 means not known, so set a small
  /// positive number for a device with hardly any damping.
  double damping = 0.0;             ///< viscous friction against translation
  double rotational_damping = 0.0;  ///< viscous friction against rotation
  double joint_damping = 0.0;       ///< viscous friction of each finger joint
  double friction = 0.0;            ///< Coulomb friction against translation, N
  double joint_friction = 0.0;      ///< Coulomb friction of each finger joint, Nm
  double resolution = 0.0;          ///< step of the measured position, or standard deviation of its noise
  double joint_resolution = 0.0;    ///< step of the measured joint angles
  /// Time from measurement to force, in addition to the period and the link. If the device measures at its own times,
  /// the delay includes the time from the measurement to the next tick.
  std::chrono::nanoseconds delay{0};
  /// Largest rates of change of the force (N/s), the torque and each joint torque (Nm/s). A rate of 0 stands for the
  /// default: from zero to the maximum in seven periods of the device, or in two periods for joint torques
  /// (`joint_torque_rate`).
  double max_force_rate = 0.0;
  double max_torque_rate = 0.0;
  double max_joint_torque_rate = 0.0;
  double max_power = 50.0;             ///< largest power that force and torque put into the hand
  double max_mean_force = 0.0;         ///< largest mean of the force's norm over about ten seconds; 0 means `max_force`
  double max_speed = 10.0;             ///< largest plausible speed; a greater one is a tracker error, m/s
  double max_turn_rate = 100.0;        ///< largest plausible angular speed, rad/s
  double workspace_radius = 1000.0;    ///< largest plausible distance from the world's origin
  std::chrono::nanoseconds frozen{0};  ///< longest plausible time with a bit-identical pose; 0: not checked
  hands::JointValues joint_lower{};    ///< lower limits of the joint angles; both limits of an absent joint are 0
  hands::JointValues joint_upper{};    ///< upper limits of the joint angles
  double update_rate = 1000.0;         ///< updates per second
  FingerCommand finger_command = FingerCommand::kTorque;
  // Only for a device whose fingers take limits:
  double limit_rate = 0.0;                  ///< updates per second of the device's own loop; 0: `update_rate`
  std::chrono::nanoseconds limit_delay{0};  ///< from measurement to torque in this loop, in addition to its period
  double max_limit_stiffness = 0.0;         ///< largest stiffness of a limit rendered without shaking, Nm/rad
  /// Joints without an actuator. The device measures them, but takes no torque and no limit for them.
  std::bitset<hands::kJoints> undriven_joints{};
  ToolCommand tool_command = ToolCommand::kWrench;
  // Only for a device that takes half-spaces:
  double tool_rate = 0.0;                  ///< updates per second of the device's own loop; 0: `update_rate`
  std::chrono::nanoseconds tool_delay{0};  ///< from measurement to force in this loop, in addition to its period

  /// Whether the device acts on a joint: the joint is there, and has an actuator.
  bool drives(std::size_t joint) const noexcept {
    return (joint_lower[joint] != 0.0 || joint_upper[joint] != 0.0) && !undriven_joints[joint];
  }
};

/// Throws std::invalid_argument, naming the device and the field, if a number is not finite or its magnitude is above
/// 1e9; a `max_` limit, `workspace_radius` or a property of the bare device or of its limits is negative; a joint's
/// lower limit is not below its upper limit, unless both are 0; the update rate is outside 1 to 100,000 Hz; `frozen` is
/// negative; or `delay`, `limit_delay` or `tool_delay` is outside 0 to 1 s.
GLISSADE_EXPORT void validate(const DeviceDescriptor& descriptor);

/// The lag (seconds) of a torque or force over the link behind the motion, for a loop with `period` and a link with
/// `link_delay`. The lag is half a period, because the force is held for a period, plus the delays of device and link.
/// The period is the longer of those of loop and device.
GLISSADE_EXPORT double lag_of(const DeviceDescriptor& descriptor, std::chrono::nanoseconds period,
                              std::chrono::nanoseconds link_delay) noexcept;

/// Like `lag_of`, for the hand root. For half-spaces, the result is the lag of the device's own loop, whatever the
/// link.
GLISSADE_EXPORT double tool_lag(const DeviceDescriptor& descriptor, std::chrono::nanoseconds period,
                                std::chrono::nanoseconds link_delay) noexcept;

/// The largest stiffness that is passive with the reported damping `told` at this lag (seconds), i.e. damping divided
/// by lag. If `told` is 0, the damping is assumed to be just enough for the largest stiffness of the device,
/// `greatest`, to be passive without a link, i.e. at the lag `own_lag`. Source: Colgate and Schenkel, Passivity of a
/// class of sampled-data systems, 1997.
GLISSADE_EXPORT double passive_limit(double told, double greatest, double own_lag, double lag) noexcept;

/// The largest stiffness (Nm/rad) of limits that the device can hold in its own loop. With the device's joint damping
/// and friction, this stiffness is passive for a finger of up to 0.5 rad/s. A faster finger may gain energy. 0 if the
/// device takes torques.
GLISSADE_EXPORT double passive_limit_stiffness(const DeviceDescriptor& descriptor) noexcept;

/// The largest damping (Nm s/rad) with which the device holds limits of this stiffness passively: the joint damping
/// that the stiffness does not need. 0 if the joint damping is not known.
GLISSADE_EXPORT double passive_limit_damping(const DeviceDescriptor& descriptor, double stiffness) noexcept;

/// The largest rate (Nm/s) of change of a joint torque.
GLISSADE_EXPORT double joint_torque_rate(const DeviceDescriptor& descriptor) noexcept;

/// The identity and capabilities of a glove.
struct GloveInfo {
  std::int64_t device = 0;   ///< number of the glove
  std::int64_t session = 0;  ///< random number that the glove's process draws at its start
  hands::HandSide side = hands::HandSide::kUnknown;
  DeviceDescriptor descriptor;
  bool is_calibrated = false;  ///< whether a `Calibration` of the wearer is applied to its states
};

class SafeCommand;

/// The interface of a device driver. Thread-safety: one thread, the haptic thread, calls `read` and `command`. Both
/// functions are wait-free, allocate nothing and make no system call. A driver that must wait for its device does so in
/// a separate thread.
class GLISSADE_EXPORT GloveDevice {
 public:
  virtual ~GloveDevice() = default;

  /// The descriptor, which never changes.
  virtual const DeviceDescriptor& descriptor() const noexcept = 0;

  /// Copies the newest state to `newest` and returns true. Until the first state has arrived, leaves `newest` unchanged
  /// and returns false. Later calls return true even if no new state has arrived. `GloveState::sequence` then stays the
  /// same.
  virtual bool read(GloveState& newest) noexcept = 0;

  /// Hands over `command` for sending. If an earlier command has not been sent yet, `command` replaces it.
  virtual void command(const SafeCommand& command) noexcept = 0;
};

}  // namespace glissade::devices

#pragma once

/// The numbers of a simulated device and its wearer's fingers: mechanics, sensors, servo loop and link. Presets
/// describe devices on the market. All numbers are in SI units: N, Nm, rad, s, Hz, kg m².

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/hands/hand.h>

namespace glissade::devices {

/// The mechanics of the wrist. A grounded arm exerts force on the hand. A tracker only measures the hand's pose.
struct WristModel {
  bool is_grounded = false;
  bool holds_half_spaces = false;         ///< the arm takes half-spaces instead of a wrench
  double max_force = 0.0;                 ///< N
  double max_torque = 0.0;                ///< Nm
  double max_stiffness = 0.0;             ///< N/m
  double max_rotational_stiffness = 0.0;  ///< Nm/rad
  double max_damping = 0.0;               ///< N s/m
  double damping = 0.0;                   ///< viscous friction of the arm, N s/m
  double rotational_damping = 0.0;        ///< Nm s/rad
  double loop_rate = 1000.0;              ///< of the loop that holds half-spaces, Hz
  double loop_delay = 0.0;                ///< from measurement to force in this loop, in addition to the period, s
  double position_noise = 0.0;            ///< standard deviation along each axis of a measured position, m
  double rotation_noise = 0.0;            ///< standard deviation of a measured rotation about each axis, rad
};

/// What moves or stops the fingers.
enum class FingerKind {
  kAbsent,      ///< the device has no fingers
  kIdeal,       ///< massless fingers, and torques without friction and lag
  kTracked,     ///< fingers are measured, but nothing acts on them
  kTorque,      ///< motors exert the torques of a command
  kJointLimit,  ///< motors hold the limits of a command in the device's own loop
  kCurlLimit,   ///< a string per finger, held by a servo, stops the flexion
  kBrake,       ///< brakes resist the motion beyond the limits of a command
};

/// The wearer's finger joints. A joint is a spring and damper between the finger and the wearer's intended angle.
/// `stiffness` is that of the relaxed finger. The stiffness grows linearly with the grip (Höppner et al., Task
/// dependency of grip stiffness, 2013). The grip is the sum of a voluntary grip and the grip of a reflex. The reflex
/// follows the load of the joint with two latencies.
struct FingerWearerModel {
  double stiffness = 0.04;      ///< Nm/rad; MCP joints have 0.033 to 0.047 (PMC7775510)
  double damping_time = 0.048;  ///< damping over stiffness, s; a hand at a handle: 6.45 N s/m over 135 N/m (srep18004)
  /// Stiffness per grip, (Nm/rad)/Nm. Chosen so that a grip of 0.2 Nm makes a stiffness of about 0.5 Nm/rad.
  double stiffness_per_grip = 2.5;
  double grip = 0.2;              ///< torque of each joint by which a closed hand holds, Nm; about 2 N at a fingertip
  double open_grip = 0.05;        ///< the same for an open hand, which moves its fingers against friction, Nm; assumed
  double reflex_gain = 0.5;       ///< grip of the reflex over the load; assumed
  double short_latency = 0.0346;  ///< s, of the first half of the reflex (PubMed 12898103)
  double long_latency = 0.0598;   ///< s, of the second half (PubMed 12898103)
  /// Root mean square of the tremor of the intended angle, rad. It is about 0.1 mm at a fingertip. Measured tremors are
  /// 15 to 254 µm (PMC3032442).
  double tremor = 0.001;
  double tremor_lowest = 6.0;    ///< lowest frequency of the tremor, Hz (PMC4594250)
  double tremor_highest = 12.0;  ///< highest frequency of the tremor, Hz (PMC4594250)
  double glove_tip_mass = 0.0;   ///< mass of the glove at each fingertip, kg
};

/// The actuator of each driven joint. Torques, friction and backlash are those at the joint.
struct ActuatorModel {
  std::array<bool, hands::kJoints> is_driven{};
  double motor_torque = 0.0;      ///< largest torque of the motor, by its current limit, Nm
  double brake_torque = 0.0;      ///< largest torque of the brake, which only resists, Nm
  double gear_ratio = 1.0;        ///< turns of the rotor per turn of the joint
  double rotor_inertia = 1e-5;    ///< of the rotor about its own axis, kg m²
  double coulomb_friction = 0.0;  ///< Nm
  double viscous_friction = 0.0;  ///< Nm s/rad
  double backlash = 0.0;          ///< lost motion between the actuator and the finger, rad
  double link_stiffness = 20.0;   ///< stiffness of tendon or linkage between the actuator and the finger, Nm/rad
  double link_damping = 0.005;    ///< damping of tendon or linkage, Nm s/rad
  double bandwidth = 100.0;       ///< cut-off frequency of the torque, a first-order lag, Hz
};

/// The device's own loop. It measures the actuator's angle, and computes the rate of this angle from two measurements.
struct ServoModel {
  double rate = 1000.0;        ///< Hz
  double delay = 0.0;          ///< from measurement to torque, in addition to the period, s
  double resolution = 0.0;     ///< step of the measured angle, rad
  double max_stiffness = 0.0;  ///< largest stiffness of a limit rendered without shaking, Nm/rad
};

/// The strings of a curl-limit device. A string limits the sum of a finger's flexion angles, and never pushes.
struct StringModel {
  double stiffness = 3.0;  ///< torque of each joint per excess of the sum, Nm/rad
  double damping = 0.002;  ///< Nm s/rad
  double torque = 0.3;     ///< largest torque of each joint, by the servo's stall torque, Nm
  double speed = 5.0;      ///< largest speed of the limit, by the servo's speed, rad/s
};

/// Measurement of the joint angles. Noise is white. The drift is an Ornstein–Uhlenbeck process.
struct JointSensorModel {
  double resolution = 0.0;    ///< step of the measured angle, rad
  double noise = 0.0;         ///< standard deviation of the noise, rad
  double drift = 0.0;         ///< standard deviation of the drift, rad
  double drift_time = 100.0;  ///< correlation time of the drift, s
};

/// The link between device and server. It applies to states and to commands. `DeviceDescriptor::delay` includes the
/// longest time of both ways, because ages of messages do not show a delay that is always there.
struct LinkModel {
  double delay = 0.0;   ///< s
  double jitter = 0.0;  ///< largest additional delay, uniformly distributed, s
  double loss = 0.0;    ///< share of lost messages, 0 to 1
};

/// Numbers of messages that the link of a model has lost, by chance or because a newer one overtook them.
struct LinkLosses {
  std::int64_t states = 0;
  std::int64_t commands = 0;
};

/// A device. The device measures, and takes a command, `update_rate` times a second.
struct GloveModel {
  std::string name;
  std::string summary;             ///< one sentence
  double update_rate = 1000.0;     ///< Hz
  double measurement_delay = 0.0;  ///< from the measurement to the state, s
  std::uint64_t seed = 1;          ///< of noise, drift, tremor, jitter and loss
  WristModel wrist;
  FingerKind fingers = FingerKind::kAbsent;
  double max_joint_torque = 0.0;  ///< of ideal fingers, Nm
  double joint_damping = 0.02;    ///< viscous friction of ideal fingers, Nm s/rad
  FingerWearerModel wearer;
  ActuatorModel actuator;  ///< for kTorque, kJointLimit and kBrake
  ServoModel servo;        ///< for kTorque, kJointLimit, kCurlLimit and kBrake
  StringModel string;      ///< for kCurlLimit
  JointSensorModel sensor;
  LinkModel link;
};

/// Throws std::invalid_argument, naming the model and the number by its key in a file, if a number is out of its range.
GLISSADE_EXPORT void validate(const GloveModel& model);

/// The descriptor that the device announces, with the true numbers of the model. The model must be valid.
GLISSADE_EXPORT DeviceDescriptor descriptor_of(const GloveModel& model);

/// The fingers of a wearer in the device of a model. An emulated firmware, in place of the device's own loop, drives
/// the motors or the strings. Integrated at 8 kHz, deterministic. Allocates only at construction.
class GLISSADE_EXPORT DrivenFingers {
 public:
  /// A number for each finger, from the thumb to the little finger.
  using PerFinger = std::array<double, 5>;

  /// Starts at rest at `angles` (rad). Motors drive fingers of kind `kJointLimit`. Strings limit fingers of kind
  /// `kCurlLimit`. Throws what `validate` throws, and std::invalid_argument for other kinds.
  DrivenFingers(const GloveModel& model, const hands::JointValues& angles);
  ~DrivenFingers();

  /// The torques of the motors (Nm at the joints) from now on.
  void set_torques(const hands::JointValues& torques) noexcept;
  /// From now on, the servo of each string moves to the position at which this sum of flexion angles (rad) tightens the
  /// string.
  void set_strings(const PerFinger& taut_sums) noexcept;

  /// Advances by `dt`. `aims` are the angles (rad) that the wearer intends. `is_closed`: the hand grips.
  void advance(std::chrono::nanoseconds dt, const hands::JointValues& aims, bool is_closed) noexcept;

  const hands::JointValues& angles() const noexcept;           ///< of the fingers, rad
  const hands::JointValues& actuator_angles() const noexcept;  ///< rad at the joints
  const hands::JointValues& actuator_rates() const noexcept;   ///< rad/s at the joints
  /// The sum of the flexion angles (rad) of each finger, which its string measures.
  PerFinger flexion_sums() const noexcept;

 private:
  struct Drive;

  std::unique_ptr<Drive> drive_;
};

/// The sum of the flexion angles (rad) of each finger with these joint angles.
GLISSADE_EXPORT DrivenFingers::PerFinger flexion_sums(const hands::JointValues& angles) noexcept;

/// The names of all presets, in alphabetic order.
GLISSADE_EXPORT std::vector<std::string_view> glove_presets();

/// The model of a preset, or else of the file with this path. Throws std::invalid_argument, naming file, line and key,
/// for a file that is not a valid model. docs/glove_models.md has the keys.
GLISSADE_EXPORT GloveModel read_glove_model(const std::string& preset_or_path);

/// The model in the text of a file. `source` is the file's name, for messages. Throws like `read_glove_model`.
GLISSADE_EXPORT GloveModel parse_glove_model(const std::string& text, const std::string& source);

}  // namespace glissade::devices

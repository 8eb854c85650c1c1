#pragma once

/// A glove of Dynamixel servos, such as the DOGlove. Servos drive some joints of the hand and measure them. A board of
/// potentiometers may measure more joints.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glissade/bridges/byte_stream.h>
#include <glissade/bridges/wire.h>
#include <glissade/devices/glove_device.h>
#include <glissade/realtime/clock.h>

namespace glissade::bridges {

/// A servo that drives a joint.
struct DynamixelServo {
  int id = 1;          ///< 0 to 252
  int joint = 0;       ///< index in `hands::kJointNames`
  double ratio = 1.0;  ///< rad of the joint per rad of the horn, by gears or a linkage; negative: they turn oppositely
  double zero = 0.0;   ///< angle of the horn while the joint angle is 0, rad; whole turns do not matter
  double torque_per_current = 0.0;  ///< Nm/A at the horn; 0: from the data sheet
  double max_current = 0.5;         ///< largest current, A
};

inline constexpr double kMeasuringBoardBaudRate = 921600.0;

/// A potentiometer of the measuring board that measures a joint.
struct MeasuredJoint {
  int channel = 0;     ///< 0 to 15
  int joint = 0;       ///< index in `hands::kJointNames`
  double ratio = 1.0;  ///< rad of the joint per rad of the potentiometer
  double zero = 0.0;   ///< angle of the potentiometer while the joint angle is 0, rad
};

/// A hand with servos of one model on one bus, and with other measured joints.
struct DynamixelHand {
  std::string name = "Dynamixel hand";
  std::string model = "XL330-M288";  ///< also XL330-M077, XC330-M288 and XC330-M181
  std::vector<DynamixelServo> servos;
  std::vector<MeasuredJoint> measured;
  double baud_rate = 3e6;                                           ///< of the bus, bits per second
  std::chrono::nanoseconds period{std::chrono::milliseconds(2)};    ///< of measurements and commands
  std::chrono::nanoseconds patience{std::chrono::milliseconds(5)};  ///< longest latency of the serial adapter
  /// A servo that receives nothing for this time stops by itself. Rounded to steps of 20 ms, from 20 ms to 2.54 s.
  std::chrono::nanoseconds watchdog{std::chrono::milliseconds(60)};
  double max_stiffness = 5.0;  ///< largest stiffness of a joint limit, Nm/rad
  int position_d_gain = 0;     ///< register Position D Gain
  /// The current (A) for which one count of the register Position P Gain asks at a position error of one count. The
  /// data sheet gives only the factor 1/128; the rest is an assumption, so measure it where stiffness matters.
  double current_per_gain = 1e-3 / 128.0;
  bool has_fast_read = false;  ///< read with one packet from all servos; needs firmware 46
  std::string board_port;      ///< of the measuring board, such as "/dev/ttyUSB1"
};

/// The configuration of a preset, or else of the file with this path. Throws std::invalid_argument, naming file, line
/// and key, for a file that is no valid configuration. docs/devices.md has the keys.
DynamixelHand read_dynamixel_hand(const std::string& preset_or_path);

/// The configuration in the text of a file. `source` is the file's name, for messages. Throws like
/// `read_dynamixel_hand`.
DynamixelHand parse_dynamixel_hand(const std::string& text, const std::string& source);

/// The names of all presets.
std::vector<std::string> dynamixel_presets();

/// Throws std::invalid_argument, naming the hand and the field, if a number is out of range, a model or joint does not
/// exist, two servos share an id, or two entries share a joint.
void validate(const DynamixelHand& hand);

/// The descriptor of the hand: its joints, and limits from the numbers of its servos. Throws what `validate` throws.
devices::DeviceDescriptor descriptor_of(const DynamixelHand& hand);

/// What passes over the wire, for people. Lists are in the order of the hand's servos.
struct DynamixelTraffic {
  std::vector<double> angles;             ///< of the joints, rad; NaN before the first measurement
  std::vector<bool> holds;                ///< the servo holds the limit of its joint
  std::uint64_t missing_answers = 0;      ///< since construction
  std::uint64_t restarted_watchdogs = 0;  ///< bus watchdogs that had expired and were started again
  bool is_free = true;  ///< the port has taken an instruction that turns all torques off, and none since
};

class DynamixelBusWire : public Wire {
 public:
  virtual DynamixelTraffic traffic() const = 0;
};

/// The wire to a hand. `bus` leads to the servos. `board` leads to the measuring board, and is null without measured
/// joints. Throws what `validate` throws, and std::invalid_argument if a line is missing.
///
/// Opening sets up each servo: turns its torque off, selects operating mode 5 (a goal position with a cap of current),
/// and starts its bus watchdog. Settings in EEPROM are written only where they differ.
///
/// A joint limit is held by the servo itself: the goal position is the limit, the cap of current its largest torque,
/// and the gain its stiffness. A servo also pulls toward its goal. So the cap is 0 while the joint is more than the
/// gear's backlash inside its range, and the torque is off farther inside. Damping of limits is not used.
///
/// On a port of the system, a second process (`ReleaseGuard`) turns the torque of all servos off when this process is
/// killed or hangs. Without it, a servo whose bus watchdog has expired would hold its place, with up to its cap of
/// current.
std::unique_ptr<DynamixelBusWire> make_dynamixel_wire(const DynamixelHand& hand, std::shared_ptr<ByteStream> bus,
                                                      std::shared_ptr<ByteStream> board = nullptr,
                                                      std::shared_ptr<realtime::Clock> clock = nullptr);

}  // namespace glissade::bridges

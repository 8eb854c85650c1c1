#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <glissade/bridges/dynamixel_check.h>
#include <glissade/bridges/serial_stream.h>
#include <glissade/bridges/wire.h>
#include <glissade/files/text.h>
#include <glissade/realtime/clock.h>

#include "dynamixel/driven_joint.h"
#include "dynamixel/measuring_board.h"
#include "dynamixel/servo_bus.h"
#include "dynamixel/servo_setup.h"

namespace glissade::bridges {
namespace {

using namespace dynamixel;
using std::chrono::nanoseconds;

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

std::string angle_text(double angle_rad) {
  return files::fixed_text(angle_rad / kRadPerDegree, 1) + "°";
}

/// One run of the check.
class ServoCheck {
 public:
  ServoCheck(const DynamixelHand& hand, const std::string& port, const std::function<bool()>& goes_on,
             const std::function<void(const std::string&)>& say)
      : hand_(hand), port_(port), goes_on_(goes_on), say_(say) {}

  bool run();

 private:
  bool finds_all(ServoBus& bus);
  std::string others_on(ServoBus& bus);
  void look_at_other_rates();
  bool tell_servo(ServoBus& bus, const DynamixelServo& servo);
  void tell_settings(ServoAccess& servo);
  bool tell_joint(ServoAccess& access, const DynamixelServo& servo);
  bool tell_time(ServoBus& bus, std::span<const std::uint8_t> ids);
  bool hears_board();
  bool answers_at(unsigned baud_rate);

  const DynamixelHand& hand_;
  const std::string& port_;
  const std::function<bool()>& goes_on_;
  const std::function<void(const std::string&)>& say_;
  realtime::SteadyClock clock_;
  bool finds_none_ = false;  // not even another servo
};

bool ServoCheck::run() {
  SerialStream line(port_, static_cast<unsigned>(hand_.baud_rate));
  line.open();
  say_(port_ + ": the port is open");
  ServoBus bus(line, clock_, {.baud_rate = hand_.baud_rate, .patience = hand_.patience});
  if (!finds_all(bus)) {
    line.close();
    if (finds_none_) look_at_other_rates();
    return false;
  }
  std::vector<std::uint8_t> ids;
  bool is_good = true;
  for (const DynamixelServo& servo : hand_.servos) {
    ids.push_back(static_cast<std::uint8_t>(servo.id));
    if (goes_on_() && !tell_servo(bus, servo)) is_good = false;
  }
  line.write(torque_off(ids));
  if (goes_on_() && !tell_time(bus, ids)) is_good = false;
  line.close();
  if (!hand_.measured.empty() && goes_on_() && !hears_board()) is_good = false;
  return is_good;
}

/// Names the servos that do not answer, and others that do.
bool ServoCheck::finds_all(ServoBus& bus) {
  constexpr int kAttempts = 3;
  std::size_t found = 0;
  for (const DynamixelServo& servo : hand_.servos) {
    bool answers = false;
    for (int i = 0; i < kAttempts && !answers; ++i)
      answers = bus.ping(static_cast<std::uint8_t>(servo.id)).has_value();
    if (answers) ++found;
    if (!answers)
      say_("servo " + std::to_string(servo.id) + " does not answer; check its supply, its cable and its id");
  }
  if (found == hand_.servos.size()) return true;
  const std::string others = others_on(bus);
  if (!others.empty()) say_("the configuration lacks servos that answer: " + others);
  finds_none_ = found == 0 && others.empty();
  return false;
}

/// The ids that answer, but are not in the configuration.
std::string ServoCheck::others_on(ServoBus& bus) {
  std::string others;
  for (int id = 0; id <= kLastId && goes_on_(); ++id) {
    const auto is_this = [id](const DynamixelServo& servo) { return servo.id == id; };
    if (std::any_of(hand_.servos.begin(), hand_.servos.end(), is_this)) continue;
    if (bus.ping(static_cast<std::uint8_t>(id))) others += (others.empty() ? "" : ", ") + std::to_string(id);
  }
  return others;
}

void ServoCheck::look_at_other_rates() {
  constexpr std::array<unsigned, 7> kBaudRates{9600, 57600, 115200, 1000000, 2000000, 3000000, 4000000};
  for (const unsigned baud_rate : kBaudRates) {
    if (!goes_on_() || !answers_at(baud_rate)) continue;
    say_("the servos answer at " + std::to_string(baud_rate) + " baud: use --baud " + std::to_string(baud_rate) +
         ", or set their register Baud Rate");
    return;
  }
  say_("no servo answers at any baud rate; is the supply on, and is this the port of the bus?");
}

bool ServoCheck::answers_at(unsigned baud_rate) {
  try {
    SerialStream line(port_, baud_rate);
    line.open();
    constexpr std::chrono::milliseconds kPatience{50};  // few are asked
    ServoBus bus(line, clock_, {.baud_rate = static_cast<double>(baud_rate), .patience = kPatience});
    return std::any_of(hand_.servos.begin(), hand_.servos.end(), [&bus](const DynamixelServo& servo) {
      return bus.ping(static_cast<std::uint8_t>(servo.id)).has_value();
    });
  } catch (const WireError&) {
    return false;  // the port does not know the rate
  }
}

/// Returns whether the servo can be used.
bool ServoCheck::tell_servo(ServoBus& bus, const DynamixelServo& servo) {
  ServoAccess access(bus, static_cast<std::uint8_t>(servo.id), port_);
  try {
    const PingAnswer identity = access.ping();
    const std::optional<ServoModel> model = find_model(identity.model);
    const double supply_V = static_cast<double>(access.read(kPresentInputVoltage)) * kPresentInputVoltage.unit;
    say_("servo " + std::to_string(servo.id) + ": " +
         (model ? std::string(model->name) : "model " + std::to_string(identity.model)) + ", firmware " +
         std::to_string(identity.firmware) + ", " + files::fixed_text(supply_V, 1) + " V, " +
         std::to_string(access.read(kPresentTemperature)) + " °C");
    const std::string trouble = trouble_of(access, hand_);
    if (!trouble.empty()) say_(access.name() + " " + trouble);
    tell_settings(access);
    return tell_joint(access, servo) && trouble.empty();
  } catch (const WireError& error) {
    say_(error.what());
    return false;
  }
}

/// What is not as the bridge needs it, but the bridge changes.
void ServoCheck::tell_settings(ServoAccess& servo) {
  const auto error = static_cast<std::uint8_t>(servo.read(kHardwareErrorStatus));
  if (error != 0)
    say_(servo.name() + " has turned its torque off: " + hardware_error_text(error) + "; the bridge restarts it");
  const std::int64_t mode = servo.read(kOperatingMode);
  if (mode != kCurrentBasedPosition)
    say_(servo.name() + " has operating mode " + std::to_string(mode) + "; the bridge sets " +
         std::to_string(kCurrentBasedPosition));
}

/// Where the joint is. Out of its range, the zero angle or the ratio of the configuration must be wrong.
bool ServoCheck::tell_joint(ServoAccess& access, const DynamixelServo& servo) {
  constexpr double kTolerance = 15.0 * kRadPerDegree;  // of a wearer
  const auto joint = static_cast<std::size_t>(servo.joint);
  const double lower = hands::kJointRanges[joint].lower_deg * kRadPerDegree;
  const double upper = hands::kJointRanges[joint].upper_deg * kRadPerDegree;
  const std::int64_t position = access.read(kPresentPosition);
  JointScale scale(hand_, servo, *find_model(hand_.model));
  scale.choose_turn(position, lower, upper);
  const double angle = scale.angle(position);
  say_("  " + std::string(hands::kJointNames[joint]) + " at " + angle_text(angle) + ", the horn at " +
       files::fixed_text(static_cast<double>(position) * kPositionUnit_rad, 3) + " rad");
  if (angle > lower - kTolerance && angle < upper + kTolerance) return true;
  say_("  no such joint turns so far (" + angle_text(lower) + " to " + angle_text(upper) +
       "): with a flat hand, zero_rad is the angle of the horn");
  return false;
}

/// How long a measurement of all servos takes, and how many are lost.
bool ServoCheck::tell_time(ServoBus& bus, std::span<const std::uint8_t> ids) {
  constexpr int kMeasurements = 100;
  std::vector<double> times_ms;
  for (int i = 0; i < kMeasurements && goes_on_(); ++i) {
    const nanoseconds start = clock_.now();
    const auto answers = bus.sync_read(ids, kFirstMeasured.address, kMeasuredSize);
    const bool is_whole =
        std::all_of(answers.begin(), answers.end(), [](const auto& answer) { return answer.has_value(); });
    if (is_whole) times_ms.push_back(std::chrono::duration<double, std::milli>(clock_.now() - start).count());
  }
  if (!goes_on_()) return true;  // stopped: nothing is known to be wrong
  const double period_ms = std::chrono::duration<double, std::milli>(hand_.period).count();
  if (times_ms.size() < kMeasurements / 2) {
    say_("more than half of the measurements are lost; check the cables and the baud rate");
    return false;
  }
  std::sort(times_ms.begin(), times_ms.end());
  const double median_ms = times_ms[times_ms.size() / 2];
  say_("a measurement takes " + files::fixed_text(median_ms, 1) + " ms, and " +
       std::to_string(kMeasurements - static_cast<int>(times_ms.size())) + " of 100 are lost");
  if (median_ms > period_ms)
    say_("that is longer than the period of " + files::fixed_text(period_ms, 1) +
         " ms, so limits come late; for an FTDI adapter, set latency_timer to 1, or raise period_s");
  return true;
}

bool ServoCheck::hears_board() {
  constexpr std::chrono::milliseconds kPatience{1000};
  SerialStream line(hand_.board_port, static_cast<unsigned>(kMeasuringBoardBaudRate));
  line.open();
  BoardDecoder decoder;
  std::size_t bytes = 0;
  for (const nanoseconds end = clock_.now() + kPatience; clock_.now() < end && goes_on_();) {
    const std::string heard = line.read(end - clock_.now());
    bytes += heard.size();
    decoder.push(heard);
    const std::optional<BoardFrame> frame = decoder.next();
    if (!frame) continue;
    const auto angles = board_angles(*frame);
    say_(hand_.board_port + ": the measuring board sends its angles, in rad:");
    for (const MeasuredJoint& measured : hand_.measured)
      say_("  channel " + std::to_string(measured.channel) + " (" +
           std::string(hands::kJointNames[static_cast<std::size_t>(measured.joint)]) + ") at " +
           files::fixed_text(angles[static_cast<std::size_t>(measured.channel)], 3));
    return true;
  }
  if (!goes_on_()) return true;  // stopped: nothing is known to be wrong
  say_(hand_.board_port + (bytes == 0 ? ": nothing arrives from the measuring board; is it on, and is this its port?"
                                      : ": bytes arrive, but no angles of a measuring board; is this its port?"));
  return false;
}

}  // namespace

bool check_dynamixel(const DynamixelHand& hand, const std::string& port, const std::function<bool()>& goes_on,
                     const std::function<void(const std::string&)>& say) {
  validate(hand);
  try {
    return ServoCheck(hand, port, goes_on, say).run();
  } catch (const WireError& error) {
    say(error.what());
    return false;
  }
}

}  // namespace glissade::bridges

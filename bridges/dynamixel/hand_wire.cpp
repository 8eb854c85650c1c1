#include "dynamixel/hand_wire.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "hand/finger_curls.h"

namespace glissade::bridges {
namespace dynamixel {
namespace {

constexpr std::chrono::milliseconds kLongestSilence{100};  // of servos and board; a lost packet is no failure
constexpr int kPeriodsPerCheck = 5;

BusSettings bus_settings(const DynamixelHand& hand) {
  return {.baud_rate = hand.baud_rate, .patience = hand.patience};
}

/// The same angle within half a turn of 0.
double within_half_turn(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

std::string seconds_text(std::chrono::nanoseconds time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(time).count()) + " ms";
}

}  // namespace

DynamixelWire::DynamixelWire(const DynamixelHand& hand, std::shared_ptr<ByteStream> bus,
                             std::shared_ptr<ByteStream> board, std::shared_ptr<realtime::Clock> clock)
    : hand_(hand),
      descriptor_(descriptor_of(hand)),
      bus_line_(std::move(bus)),
      board_line_(std::move(board)),
      clock_(std::move(clock)),
      bus_(*bus_line_, *clock_, bus_settings(hand)) {
  const ServoModel model = *find_model(hand_.model);
  for (const DynamixelServo& servo : hand_.servos) {
    joints_.emplace_back(hand_, servo, model);
    ids_.push_back(static_cast<std::uint8_t>(servo.id));
  }
}

void DynamixelWire::open() {
  if (guard_) guard_->disarm();  // it had the port until now, if a release had failed
  bus_line_->open();
  if (board_line_) board_line_->open();
  board_.clear();
  has_board_frame_ = false;
  const ServoModel model = *find_model(hand_.model);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    DrivenJoint& joint = joints_[i];
    joint = DrivenJoint(hand_, hand_.servos[i], model);
    ServoAccess servo = access(joint);
    const std::int64_t position = set_up(servo, hand_, joint.scale, *clock_);
    joint.scale.choose_turn(position, descriptor_.joint_lower[joint.joint], descriptor_.joint_upper[joint.joint]);
  }
  is_free_ = true;  // all servos have confirmed that their torque is off
  guard_port();
  next_ = measured_ = board_measured_ = clock_->now();
}

void DynamixelWire::guard_port() {
  if (bus_line_->descriptor() < 0) return;
  if (!guard_) guard_.emplace();
  guard_->arm(bus_line_->descriptor(), torque_off(ids_));
}

void DynamixelWire::wait_for_period() {
  clock_->sleep_until(next_);
  // A late period shifts those that follow, instead of crowding them.
  next_ = std::max(next_ + hand_.period, clock_->now());
}

bool DynamixelWire::read(devices::GloveState& state) {
  wait_for_period();
  const std::chrono::nanoseconds time = clock_->now();
  const bool has_board = measure_board();
  if (!measure_servos() || !has_board) return false;
  check_next_servo();
  state.time = time;
  state.joint_angles = angles_of({});  // of the joints that nothing measures: an open hand, the thumb opposite
  for (const DrivenJoint& joint : joints_)
    state.joint_angles[joint.joint] = joint.angle;
  for (const MeasuredJoint& measured : hand_.measured) {
    const double turned = board_angles_[static_cast<std::size_t>(measured.channel)] - measured.zero;
    state.joint_angles[static_cast<std::size_t>(measured.joint)] = measured.ratio * within_half_turn(turned);
  }
  return true;
}

/// Returns whether all servos have answered.
bool DynamixelWire::measure_servos() {
  const auto answers = hand_.has_fast_read ? bus_.fast_sync_read(ids_, kFirstMeasured.address, kMeasuredSize)
                                           : bus_.sync_read(ids_, kFirstMeasured.address, kMeasuredSize);
  bool are_all_there = true;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const std::optional<Answer>& answer = answers[i];
    if (answer && has_alert(answer->error)) fail_by_hardware_error(joints_[i]);
    if (answer && answer->data.size() == kMeasuredSize) {
      joints_[i].take_measurement(answer->data);
    } else {
      are_all_there = false;
    }
  }
  const std::chrono::nanoseconds now = clock_->now();
  if (are_all_there) measured_ = now;
  if (now - measured_ > kLongestSilence) fail_by_silence(answers);
  return are_all_there;
}

/// Takes the newest frame of the board. Returns whether there has been one.
bool DynamixelWire::measure_board() {
  if (!board_line_) return true;
  board_.push(board_line_->read(std::chrono::nanoseconds(0)));
  while (const std::optional<BoardFrame> frame = board_.next()) {
    board_angles_ = board_angles(*frame);
    board_measured_ = clock_->now();
    has_board_frame_ = true;
  }
  if (clock_->now() - board_measured_ > kLongestSilence) {
    throw WireError("The measuring board on " + board_line_->name() + " has sent nothing for " +
                    seconds_text(kLongestSilence) + "; check its supply, its cable and the baud rate of " +
                    std::to_string(static_cast<int>(kMeasuringBoardBaudRate)) + ".");
  }
  return has_board_frame_;
}

/// Every few periods, compares the state of one servo with what was sent, which has no answer.
void DynamixelWire::check_next_servo() {
  if (++periods_to_check_ < kPeriodsPerCheck) return;
  periods_to_check_ = 0;
  DrivenJoint& joint = joints_[next_checked_];
  next_checked_ = (next_checked_ + 1) % joints_.size();
  constexpr std::uint16_t kSize = kBusWatchdog.address + kBusWatchdog.size - kTorqueEnable.address;
  const std::optional<Answer> answer = bus_.read(joint.id, kTorqueEnable.address, kSize);
  if (!answer || answer->data.size() != kSize) return;
  if (has_alert(answer->error)) fail_by_hardware_error(joint);
  const std::string_view table = answer->data;
  const std::int64_t watchdog =
      decode_register(kBusWatchdog, table.substr(kBusWatchdog.address - kTorqueEnable.address, kBusWatchdog.size));
  if (watchdog == kWatchdogExpired) return restart_watchdog(joint);
  if (watchdog != watchdog_count(hand_)) {
    access(joint).fail("has lost its settings, probably by an interruption of its supply");
  }
  joint.has_torque = table[0] != 0;
}

/// A servo whose watchdog has expired holds its place and refuses goals. It begins anew, without torque.
void DynamixelWire::restart_watchdog(DrivenJoint& joint) {
  ServoAccess servo = access(joint);
  start_watchdog(servo, hand_);
  joint.forget();
  ++restarted_watchdogs_;
}

void DynamixelWire::fail_by_hardware_error(const DrivenJoint& joint) {
  ServoAccess servo = access(joint);
  const auto error = static_cast<std::uint8_t>(servo.read(kHardwareErrorStatus));
  servo.fail("has turned its torque off: " + (error != 0 ? hardware_error_text(error) : "of an unknown error"));
}

void DynamixelWire::fail_by_silence(const std::vector<std::optional<Answer>>& answers) {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i] && answers[i]->data.size() == kMeasuredSize) continue;
    access(joints_[i]).fail("has not answered for " + seconds_text(kLongestSilence) + "; check its supply and cable");
  }
  throw WireError("The servos on " + bus_line_->name() + " have not answered together for " +
                  seconds_text(kLongestSilence) + ".");
}

void DynamixelWire::write(const devices::SafeCommand& command) {
  if (guard_) guard_->renew();
  const devices::JointLimits& limits = command.values().joint_limits;
  for (DrivenJoint& joint : joints_)
    joint.set_limit(limits.joints[joint.joint]);
  for (const DrivenJoint& joint : joints_)
    is_free_ = is_free_ && !joint.goal.has_torque;
  send_goals(bus_, joints_);
}

DynamixelTraffic DynamixelWire::traffic() const {
  DynamixelTraffic traffic;
  for (const DrivenJoint& joint : joints_) {
    traffic.angles.push_back(joint.angle);
    traffic.holds.push_back(joint.goal.has_torque && joint.goal.max_torque > 0.0);
  }
  traffic.missing_answers = bus_.statistics().missing_answers;
  traffic.restarted_watchdogs = restarted_watchdogs_;
  traffic.is_free = is_free_;
  return traffic;
}

void DynamixelWire::release() noexcept {
  constexpr int kRepeats = 3;  // nothing confirms them
  for (DrivenJoint& joint : joints_)
    joint.forget();
  try {
    for (int i = 0; i < kRepeats && bus_line_->is_open(); ++i)
      bus_line_->write(torque_off(ids_));
    is_free_ = is_free_ || bus_line_->is_open();
    if (is_free_ && guard_) guard_->disarm();
  } catch (const std::exception&) {
    // The line is gone: the second process tries, and the bus watchdogs stop the servos.
  }
  bus_line_->close();
  if (board_line_) board_line_->close();
}

}  // namespace dynamixel

std::unique_ptr<DynamixelBusWire> make_dynamixel_wire(const DynamixelHand& hand, std::shared_ptr<ByteStream> bus,
                                                      std::shared_ptr<ByteStream> board,
                                                      std::shared_ptr<realtime::Clock> clock) {
  validate(hand);
  if (!bus) throw std::invalid_argument("A hand of Dynamixel servos needs a line to its bus.");
  if (hand.measured.empty() != !board)
    throw std::invalid_argument("A hand needs a line to its measuring board if and only if the board measures joints.");
  if (!clock) clock = std::make_shared<realtime::SteadyClock>();
  return std::make_unique<dynamixel::DynamixelWire>(hand, std::move(bus), std::move(board), std::move(clock));
}

}  // namespace glissade::bridges

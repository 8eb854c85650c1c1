#include "dynamixel/emulated_glove.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "emulation/emulated_hand.h"

namespace glissade::bridges::dynamixel {
namespace {

/// The fingers that all servos of a glove turn.
struct SharedFingers {
  SharedFingers(const devices::GloveModel& model, EmulatedWearer wearer) : hand(model, std::move(wearer)) {}

  EmulatedHand hand;
  hands::JointValues torques{};
};

/// The joint at the horn of a servo. The hand goes on with the servo that is the first to do a step; the torques of
/// this step act in the next one.
class JointAtHorn final : public HornLoad {
 public:
  JointAtHorn(const DynamixelServo& servo, std::shared_ptr<SharedFingers> fingers)
      : servo_(servo), joint_(static_cast<std::size_t>(servo.joint)), fingers_(std::move(fingers)) {}

  double angle() const noexcept override {
    return servo_.zero + fingers_->hand.fingers().actuator_angles()[joint_] / servo_.ratio;
  }
  double rate() const noexcept override { return fingers_->hand.fingers().actuator_rates()[joint_] / servo_.ratio; }
  void step(double torque, double dt) noexcept override {
    time_ += std::chrono::nanoseconds(std::llround(dt * 1e9));
    fingers_->hand.advance_to(time_);
    fingers_->torques[joint_] = torque / servo_.ratio;
    fingers_->hand.fingers().set_torques(fingers_->torques);
  }

 private:
  DynamixelServo servo_;
  std::size_t joint_;
  std::shared_ptr<SharedFingers> fingers_;
  std::chrono::nanoseconds time_{0};
};

EmulatedBoard::Angles potentiometers(const DynamixelHand& hand, const hands::JointValues& joints) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  EmulatedBoard::Angles angles{};
  for (const MeasuredJoint& measured : hand.measured) {
    const double angle = measured.zero + joints[static_cast<std::size_t>(measured.joint)] / measured.ratio;
    angles[static_cast<std::size_t>(measured.channel)] = angle - kTurn_rad * std::floor(angle / kTurn_rad);
  }
  return angles;
}

}  // namespace

devices::GloveModel model_of(const DynamixelHand& hand) {
  validate(hand);
  devices::GloveModel model = devices::read_glove_model("dynamixel");
  model.actuator.motor_torque = find_model(hand.model)->stall_torque_Nm;
  model.actuator.is_driven = {};
  for (const DynamixelServo& servo : hand.servos)
    model.actuator.is_driven[static_cast<std::size_t>(servo.joint)] = true;
  return model;
}

ServoGlove emulate(const DynamixelHand& hand, const devices::GloveModel& model, EmulatedWearer wearer) {
  validate(hand);
  const auto fingers = std::make_shared<SharedFingers>(model, std::move(wearer));
  std::vector<EmulatedServo> servos;
  for (const DynamixelServo& servo : hand.servos) {
    servos.emplace_back(static_cast<std::uint8_t>(servo.id), *find_model(hand.model),
                        std::make_shared<JointAtHorn>(servo, fingers));
  }
  ServoGlove glove;
  glove.bus = std::make_shared<EmulatedBus>(std::move(servos), hand.baud_rate);
  if (hand.measured.empty()) return glove;
  constexpr std::chrono::milliseconds kBoardPeriod{5};
  const auto angles = [hand, fingers](std::chrono::nanoseconds time) {
    fingers->hand.advance_to(time);
    return potentiometers(hand, fingers->hand.fingers().angles());
  };
  glove.board = std::make_shared<EmulatedBoard>(angles, kBoardPeriod);
  return glove;
}

}  // namespace glissade::bridges::dynamixel

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glissade/bridges/dynamixel_emulation.h>

#include "dynamixel/emulated_board.h"
#include "dynamixel/emulated_bus.h"
#include "dynamixel/emulated_line.h"

namespace glissade::bridges {
namespace dynamixel {
namespace {

/// Where the wearer wants a joint after so many seconds, rad.
double wanted_angle(const EmulatedWearer& wearer, int joint, double time_s) {
  const double upper = hands::kJointRanges[static_cast<std::size_t>(joint)].upper_deg * std::numbers::pi / 180.0;
  const double cycle_s = std::chrono::duration<double>(wearer.cycle).count();
  const double share = cycle_s > 0.0 ? 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * time_s / cycle_s) : 1.0;
  return share * wearer.closed * upper;
}

/// The joint at the horn of a servo.
class ClosingFinger final : public HornLoad {
 public:
  ClosingFinger(const DynamixelServo& servo, const EmulatedWearer& wearer)
      : servo_(servo),
        wearer_(wearer),
        finger_(servo.zero, wearer.stiffness * servo.ratio * servo.ratio, wearer.damping * servo.ratio * servo.ratio) {}

  double angle() const noexcept override { return finger_.angle(); }
  double rate() const noexcept override { return finger_.rate(); }
  void step(double torque, double dt) noexcept override {
    time_s_ += dt;
    finger_.aim = servo_.zero + wanted_angle(wearer_, servo_.joint, time_s_) / servo_.ratio;
    finger_.step(torque, dt);
  }

 private:
  DynamixelServo servo_;
  EmulatedWearer wearer_;
  ElasticFinger finger_;
  double time_s_ = 0.0;
};

EmulatedBoard::Angles potentiometers(const DynamixelHand& hand, const EmulatedWearer& wearer, double time_s) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  EmulatedBoard::Angles angles{};
  for (const MeasuredJoint& measured : hand.measured) {
    const double angle = measured.zero + wanted_angle(wearer, measured.joint, time_s) / measured.ratio;
    angles[static_cast<std::size_t>(measured.channel)] = angle - kTurn_rad * std::floor(angle / kTurn_rad);
  }
  return angles;
}

}  // namespace
}  // namespace dynamixel

EmulatedDynamixelHand emulate(const DynamixelHand& hand, const EmulatedWearer& wearer,
                              std::shared_ptr<realtime::Clock> clock) {
  using namespace dynamixel;
  validate(hand);
  if (!clock) clock = std::make_shared<realtime::SteadyClock>();
  const ServoModel model = *find_model(hand.model);
  std::vector<EmulatedServo> servos;
  for (const DynamixelServo& servo : hand.servos)
    servos.emplace_back(static_cast<std::uint8_t>(servo.id), model, std::make_shared<ClosingFinger>(servo, wearer));
  EmulatedDynamixelHand result;
  result.bus = std::make_shared<EmulatedLine>(std::make_shared<EmulatedBus>(std::move(servos), hand.baud_rate), clock);
  if (hand.measured.empty()) return result;
  constexpr std::chrono::milliseconds kBoardPeriod{5};
  const auto angles = [hand, wearer](std::chrono::nanoseconds time) {
    return potentiometers(hand, wearer, std::chrono::duration<double>(time).count());
  };
  result.board = std::make_shared<EmulatedLine>(std::make_shared<EmulatedBoard>(angles, kBoardPeriod), clock);
  return result;
}

}  // namespace glissade::bridges

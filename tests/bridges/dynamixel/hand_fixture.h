#pragma once

/// A hand of emulated servos on a simulated clock.

#include <chrono>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/devices/safety_envelope.h>

#include "dynamixel/emulated_bus.h"
#include "dynamixel/hand_wire.h"
#include "elastic_finger.h"
#include "emulation/emulated_line.h"
#include "emulation/faulty_device.h"

namespace glissade::bridges::dynamixel {

constexpr int kIndexPip = 5;
constexpr int kMiddlePip = 8;
constexpr double kZero_rad = std::numbers::pi;  // of the horns
constexpr double kFingerStiffness = 0.5;        // Nm/rad
constexpr double kFingerDamping = 0.025;        // Nm s/rad

/// Two servos, with ids 1 and 2, at the middle joints of index and middle finger.
class HandOfServos : public testing::Test {
 protected:
  static DynamixelHand two_fingers() {
    DynamixelHand hand;
    hand.servos = {{.id = 1, .joint = kIndexPip, .zero = kZero_rad}, {.id = 2, .joint = kMiddlePip, .zero = kZero_rad}};
    return hand;
  }

  HandOfServos() {
    const ServoModel model = *find_model("XL330-M288");
    bus_ = std::make_shared<EmulatedBus>(std::vector<EmulatedServo>{{1, model, index_}, {2, model, middle_}}, 3e6);
    device_ = std::make_shared<FaultyDevice>(bus_, 5);
    line_ = std::make_shared<EmulatedLine>(device_, clock_);
    make_wire(two_fingers());
  }

  void make_wire(const DynamixelHand& hand, std::shared_ptr<ByteStream> board = nullptr) {
    hand_ = hand;
    wire_ = std::make_unique<DynamixelWire>(hand, line_, std::move(board), clock_);
    envelope_ = std::make_unique<devices::SafetyEnvelope>(wire_->descriptor(), 20.0);
  }

  /// One period: measure, limit the command, send it. Returns whether a measurement came.
  bool period() {
    const bool is_measured = wire_->read(state_);
    if (is_measured) ++state_.sequence;
    devices::GloveCommand command;
    command.joint_limits = limits_;
    command.sequence = state_.sequence;
    command.state_sequence = state_.sequence;
    command.state_time = state_.time;
    wire_->write(envelope_->limit(command, state_, clock_->now()));
    return is_measured;
  }

  /// Returns the number of measurements.
  int run_for(std::chrono::milliseconds time) {
    int measured = 0;
    for (const std::chrono::nanoseconds end = clock_->now() + time; clock_->now() < end;)
      measured += period() ? 1 : 0;
    return measured;
  }

  devices::JointLimit& limit_of_index() { return limits_.joints[kIndexPip]; }
  double index_angle() const { return index_->angle() - kZero_rad; }
  EmulatedServo& servo(std::uint8_t id) { return bus_->servo(id); }

  std::shared_ptr<realtime::SimulatedClock> clock_ = std::make_shared<realtime::SimulatedClock>();
  std::shared_ptr<ElasticFinger> index_ = std::make_shared<ElasticFinger>(kZero_rad, kFingerStiffness, kFingerDamping);
  std::shared_ptr<ElasticFinger> middle_ = std::make_shared<ElasticFinger>(kZero_rad, kFingerStiffness, kFingerDamping);
  std::shared_ptr<EmulatedBus> bus_;
  std::shared_ptr<FaultyDevice> device_;
  std::shared_ptr<EmulatedLine> line_;
  DynamixelHand hand_;
  std::unique_ptr<DynamixelWire> wire_;
  std::unique_ptr<devices::SafetyEnvelope> envelope_;
  devices::GloveState state_;
  devices::JointLimits limits_;
};

/// The sentence of the WireError that `action` throws; empty if it throws none.
template <class Action>
std::string wire_error_of(const Action& action) {
  try {
    action();
  } catch (const WireError& error) {
    return error.what();
  }
  return {};
}

}  // namespace glissade::bridges::dynamixel

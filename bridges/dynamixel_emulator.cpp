#include <utility>

#include <glissade/bridges/dynamixel_emulator.h>

#include "dynamixel/emulated_glove.h"
#include "emulation/faulty_device.h"
#include "emulation/port_runner.h"

namespace glissade::bridges {
namespace {

PluggedDevice plugged(std::shared_ptr<EmulatedDevice> device, const std::string& link, double baud_rate,
                      const DynamixelEmulatorOptions& options) {
  const auto line = std::make_shared<FaultyDevice>(std::move(device), options.seed);
  line->faults = options.faults;
  return {.port = EmulatedPort::terminal(link), .device = line, .baud_rate = static_cast<unsigned>(baud_rate)};
}

std::vector<PluggedDevice> both(const DynamixelHand& hand, const dynamixel::ServoGlove& glove,
                                const DynamixelEmulatorOptions& options) {
  std::vector<PluggedDevice> result;
  result.push_back(plugged(glove.bus, options.link, hand.baud_rate, options));
  if (glove.board) result.push_back(plugged(glove.board, options.board_link, kMeasuringBoardBaudRate, options));
  return result;
}

}  // namespace

struct DynamixelEmulator::Parts {
  Parts(const DynamixelHand& of, const DynamixelEmulatorOptions& options)
      : hand(of),
        glove(dynamixel::emulate(hand, dynamixel::model_of(hand), options.wearer)),
        runner(both(hand, glove, options)) {}

  DynamixelHand hand;
  dynamixel::ServoGlove glove;
  PortRunner runner;
};

DynamixelEmulator::DynamixelEmulator(const DynamixelHand& hand, const DynamixelEmulatorOptions& options)
    : parts_(std::make_unique<Parts>(hand, options)) {}

DynamixelEmulator::~DynamixelEmulator() = default;

std::string DynamixelEmulator::port() const {
  return parts_->runner.port(0);
}

std::string DynamixelEmulator::board_port() const {
  return parts_->glove.board ? parts_->runner.port(1) : std::string();
}

std::vector<EmulatedServoState> DynamixelEmulator::servos() const {
  return parts_->runner.at_rest([&] {
    std::vector<EmulatedServoState> states;
    for (const DynamixelServo& servo : parts_->hand.servos) {
      dynamixel::EmulatedServo& emulated = parts_->glove.bus->servo(static_cast<std::uint8_t>(servo.id));
      states.push_back({.has_torque = emulated.get(dynamixel::kTorqueEnable) != 0,
                        .torque = emulated.torque() / servo.ratio,
                        .angle = servo.ratio * (emulated.load().angle() - servo.zero)});
    }
    return states;
  });
}

void DynamixelEmulator::unplug() {
  parts_->runner.unplug();
}

void DynamixelEmulator::plug() {
  parts_->runner.plug();
}

}  // namespace glissade::bridges

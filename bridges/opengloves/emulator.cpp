#include <utility>
#include <vector>

#include <glissade/bridges/opengloves_emulator.h>

#include "emulation/emulated_hand.h"
#include "emulation/faulty_device.h"
#include "emulation/port_runner.h"
#include "opengloves/emulated_firmware.h"

namespace glissade::bridges {
namespace {

std::shared_ptr<EmulatedFirmware> firmware_of(const OpenGlovesEmulatorOptions& options) {
  return std::make_shared<EmulatedFirmware>(options, std::make_shared<EmulatedHand>(options.model, options.wearer));
}

std::vector<PluggedDevice> plugged(const OpenGlovesEmulatorOptions& options,
                                   const std::shared_ptr<EmulatedFirmware>& firmware) {
  const auto line = std::make_shared<FaultyDevice>(firmware, options.seed);
  line->faults = options.faults;
  EmulatedPort port = options.is_tcp ? EmulatedPort::tcp(options.tcp_port) : EmulatedPort::terminal(options.link);
  std::vector<PluggedDevice> result;
  result.push_back({.port = std::move(port), .device = line, .baud_rate = kOpenGlovesBaudRate});
  return result;
}

}  // namespace

struct OpenGlovesEmulator::Parts {
  explicit Parts(const OpenGlovesEmulatorOptions& options)
      : firmware(firmware_of(options)), runner(plugged(options, firmware)) {}

  std::shared_ptr<EmulatedFirmware> firmware;
  PortRunner runner;
};

OpenGlovesEmulator::OpenGlovesEmulator(const OpenGlovesEmulatorOptions& options)
    : parts_(std::make_unique<Parts>(options)) {}

OpenGlovesEmulator::~OpenGlovesEmulator() = default;

std::string OpenGlovesEmulator::port() const {
  return parts_->runner.port(0);
}

EmulatedGlove OpenGlovesEmulator::state() const {
  return parts_->runner.at_rest([&] { return parts_->firmware->state(); });
}

void OpenGlovesEmulator::unplug() {
  parts_->runner.unplug();
}

void OpenGlovesEmulator::plug() {
  parts_->runner.plug();
}

}  // namespace glissade::bridges

#include <utility>

#include <glissade/devices/lcm_glove.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {

LcmGloveHost::LcmGloveHost(std::shared_ptr<LcmBus> bus, const LcmGloveHostOptions& options)
    : bus_(checked_bus(std::move(bus), "The host of an LCM glove")),
      command_timeout_(options.command_timeout),
      monitor_(std::make_unique<LinkMonitor>(options.restart_silence)) {
  subscription_ = bus_->subscribe(kGloveCommandChannel, [this](std::span<const std::uint8_t> message) {
    ReceivedCommand received;
    const MessageError error = decode(message, received.command);
    received.arrival = clock_.now();
    if (monitor_->admit(error, received.command.sequence, received.arrival)) commands_.publish(received);
  });
}

LcmGloveHost::~LcmGloveHost() = default;

bool LcmGloveHost::publish(const GloveState& state) {
  return bus_->publish(kGloveStateChannel, encode(state));
}

GloveCommand LcmGloveHost::newest_command() noexcept {
  const ReceivedCommand& newest = commands_.latest();
  GloveCommand command = newest.command;
  if (clock_.now() - newest.arrival > command_timeout_) {
    command.f_H_W.setZero();
    command.t_H_W.setZero();
    command.joint_torques.fill(0.0);
  }
  return command;
}

LinkStatistics LcmGloveHost::statistics() const noexcept {
  return monitor_->statistics();
}

}  // namespace glissade::devices

#include <utility>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/safety_limits.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {

LcmGlove::LcmGlove(std::shared_ptr<LcmBus> bus, DeviceDescriptor descriptor, const LcmGloveOptions& options)
    : bus_(checked_bus(std::move(bus), "An LCM glove")),
      descriptor_(std::move(descriptor)),
      monitor_(std::make_unique<LinkMonitor>(options.restart_silence)) {
  validate(descriptor_);
  subscription_ = bus_->subscribe(kGloveStateChannel, [this](std::span<const std::uint8_t> message) {
    GloveState state;
    const MessageError error = decode(message, state);
    if (monitor_->admit(error, state.sequence, clock_.now())) states_.publish(state);
  });
  sender_ = std::make_unique<realtime::PeriodicThread>(
      clock_, realtime::PeriodicThreadOptions{.period = options.send_period}, [this](const realtime::PeriodicTick&) {
        if (commands_.update()) send(commands_.value());
        return true;
      });
}

LcmGlove::~LcmGlove() {
  sender_->stop();
  subscription_.reset();
  if (commands_sent() == 0) return;
  GloveCommand rest;
  rest.sequence = commands_.value().sequence + 1;
  rest.state_sequence = commands_.value().state_sequence;
  rest.time = clock_.now();
  send(rest);
}

bool LcmGlove::read(GloveState& newest) noexcept {
  has_state_ = states_.update() || has_state_;
  if (has_state_) newest = states_.value();
  return has_state_;
}

void LcmGlove::command(const GloveCommand& command) noexcept {
  commands_.publish(command);
}

// A command that cannot be encoded or sent counts as lost on the way: the glove's command timeout covers both.
void LcmGlove::send(const GloveCommand& command) noexcept {
  try {
    if (bus_->publish(kGloveCommandChannel, encode(limit_command(command, descriptor_).command))) {
      commands_sent_.fetch_add(1, std::memory_order_relaxed);
    }
  } catch (...) {  // NOLINT(bugprone-empty-catch): a lost message is no reason to end the thread
  }
}

LinkStatistics LcmGlove::statistics() const noexcept {
  return monitor_->statistics();
}

}  // namespace glissade::devices

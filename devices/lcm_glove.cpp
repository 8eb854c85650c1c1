#include <utility>

#include <glissade/devices/lcm_glove.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {

LcmGlove::LcmGlove(std::shared_ptr<LcmBus> bus, DeviceDescriptor descriptor, const LcmGloveOptions& options)
    : bus_(checked_bus(std::move(bus), "An LCM glove")),
      descriptor_(std::move(descriptor)),
      device_(options.device),
      session_(random_session()),
      monitor_(std::make_unique<LinkMonitor>(options.lease)) {
  validate(descriptor_);
  if (options.glove_session != 0) monitor_->grant(device_, options.glove_session, clock_.now());
  subscription_ = bus_->subscribe(kGloveStateChannel, [this](std::span<const std::uint8_t> message) {
    StateHeader header;
    GloveState state;
    DecodeResult result = decode(message, header, state);
    if (result == MessageError::kNone && header.device != device_) result = MessageError::kOtherReceiver;
    if (!monitor_->admit(result, {header.device, header.session, state.sequence}, clock_.now())) return;
    state.obeys_another = header.leaseholder != 0 && header.leaseholder != session_;
    if (header.leaseholder != session_) {  // what the glove tells concerns the commands of another server, or none
      state.limits = {};
      state.command_age = std::chrono::nanoseconds(0);
      state.link_delay = std::chrono::nanoseconds(0);
      state.energy = 0.0;
      state.taken = 0.0;
    }
    states_.publish(state);
  });
  sender_ = std::make_unique<realtime::PeriodicThread>(
      clock_,
      realtime::PeriodicThreadOptions{.period = options.send_period,
                                      .fifo_priority = realtime::kLinkPriority,
                                      .fifo_share = realtime::kLinkShare,
                                      .name = "lcm-send"},
      [this](const realtime::PeriodicTick&) {
        commands_.pop_waiting([this](const SafeCommand& command) { send(command.values()); });
        return true;
      });
}

LcmGlove::~LcmGlove() {
  sender_->stop();
  if (commands_sent() > 0) {
    GloveCommand rest;
    rest.sequence = last_sent_.sequence + 1;
    rest.state_sequence = last_sent_.state_sequence;
    rest.state_time = last_sent_.state_time;
    rest.time = clock_.now();
    send(rest);
  }
  subscription_.reset();
}

bool LcmGlove::read(GloveState& newest) noexcept {
  has_state_ = states_.update() || has_state_;
  if (has_state_) newest = states_.value();
  return has_state_;
}

void LcmGlove::command(const SafeCommand& command) noexcept {
  commands_.push(command);
}

// A command that cannot be encoded or sent counts as lost on the way: the glove's envelope covers both.
void LcmGlove::send(const GloveCommand& command) noexcept {
  try {
    const CommandHeader header{.device = device_, .glove_session = monitor_->session(), .session = session_};
    last_sent_ = command;
    if (bus_->publish(kGloveCommandChannel, encode(header, command))) {
      commands_sent_.fetch_add(1, std::memory_order_relaxed);
    }
  } catch (...) {  // NOLINT(bugprone-empty-catch): a lost message is no reason to end the thread
  }
}

LinkStatistics LcmGlove::statistics() const noexcept {
  return monitor_->statistics();
}

}  // namespace glissade::devices

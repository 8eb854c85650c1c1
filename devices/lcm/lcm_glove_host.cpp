#include <chrono>
#include <utility>

#include <glissade/devices/lcm_glove.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {

namespace {

constexpr std::chrono::milliseconds kPeriodOfServers{1};  // a faster glove waits for them

}  // namespace

LcmGloveHost::LcmGloveHost(std::shared_ptr<LcmBus> bus, const DeviceDescriptor& descriptor,
                           const LcmGloveHostOptions& options)
    : bus_(checked_bus(std::move(bus), "The host of an LCM glove")),
      options_(options),
      session_(random_session()),
      envelope_(descriptor, options.patience_periods, kPeriodOfServers),
      monitor_(std::make_unique<LinkMonitor>(options.lease)) {
  subscription_ = bus_->subscribe(kGloveCommandChannel, [this](std::span<const std::uint8_t> message) {
    CommandHeader header;
    GloveCommand command;
    DecodeResult result = decode(message, header, command);
    const bool is_for_us = header.device == options_.device && header.glove_session == session_;
    if (result == MessageError::kNone && !is_for_us) result = MessageError::kOtherReceiver;
    if (monitor_->admit(result, {header.device, header.session, command.sequence}, clock_.now())) {
      commands_.publish(command);
    }
  });
  announcements_ = bus_->subscribe(kGloveInfoChannel, [this](std::span<const std::uint8_t> message) {
    GloveInfo info;
    if (decode(message, info) != MessageError::kNone) return;
    if (info.device == options_.device && info.session != session_)
      shares_number_.store(true, std::memory_order_relaxed);
  });
}

LcmGloveHost::~LcmGloveHost() = default;

bool LcmGloveHost::publish(const GloveState& state) {
  constexpr std::chrono::milliseconds kAnnouncements{200};
  const std::chrono::nanoseconds now = clock_.now();
  if (!announced_ || now - *announced_ >= kAnnouncements) {
    announced_ = now;
    const GloveInfo info{
        .device = options_.device, .session = session_, .side = options_.side, .descriptor = envelope_.descriptor()};
    bus_->publish(kGloveInfoChannel, encode(info));
  }
  const StateHeader header{
      .device = options_.device, .session = session_, .leaseholder = monitor_->leaseholder(now), .side = options_.side};
  GloveState told = state;
  told.limits = last_.reasons();
  told.command_age = last_.age();
  told.link_delay = envelope_.link_delay();
  told.energy = last_.energy();
  told.taken = last_.taken();
  return bus_->publish(kGloveStateChannel, encode(header, told));
}

SafeCommand LcmGloveHost::newest_command(const GloveState& newest) noexcept {
  if (should_stop_.load(std::memory_order_relaxed)) envelope_.stop();
  GloveState measured = newest;
  measured.link_delay = std::chrono::nanoseconds(0);  // here is the envelope that limits the energy
  last_ = envelope_.limit(commands_.latest(), measured, clock_.now());
  return last_;
}

LinkStatistics LcmGloveHost::statistics() const noexcept {
  return monitor_->statistics();
}

}  // namespace glissade::devices

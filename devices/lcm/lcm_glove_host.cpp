#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <glissade/devices/lcm_glove.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"

namespace glissade::devices {

namespace {

constexpr std::chrono::milliseconds kPeriodOfServers{1};  // a faster glove waits for them

/// The device as server and wearer see it.
DeviceDescriptor calibrated(const DeviceDescriptor& device, const LcmGloveHostOptions& options) {
  if (options.calibration) check_calibration(*options.calibration, device, options.side);
  DeviceDescriptor descriptor = options.calibration ? options.calibration->calibrated(device) : device;
  if (!options.hand_pose) return descriptor;
  if (device.max_force > 0.0 || device.max_torque > 0.0)
    throw std::invalid_argument("The device '" + device.name +
                                "' exerts force on the hand, so it must measure the pose of the hand itself.");
  return descriptor;
}

/// A command may answer a state with a pose of two of the tracker's periods ago. What fades, fades at the device's own
/// rate, however slow the tracker is.
double patience_periods(const DeviceDescriptor& device, const LcmGloveHostOptions& options) {
  if (!options.hand_pose) return options.patience_periods;
  const double period_s = std::max(1.0 / device.update_rate, std::chrono::duration<double>(kPeriodOfServers).count());
  return std::max(options.patience_periods, 2.0 / (options.hand_pose->rate_Hz * period_s));
}

}  // namespace

LcmGloveHost::LcmGloveHost(std::shared_ptr<LcmBus> bus, const DeviceDescriptor& descriptor,
                           const LcmGloveHostOptions& options)
    : bus_(checked_bus(std::move(bus), "The host of an LCM glove")),
      options_(options),
      hand_pose_(options.hand_pose ? std::make_unique<HandPoseSource>(bus_, *options.hand_pose) : nullptr),
      session_(random_session()),
      envelope_(calibrated(descriptor, options), patience_periods(descriptor, options), kPeriodOfServers),
      monitor_(std::make_unique<LinkMonitor>(options.lease)) {
  subscription_ = bus_->subscribe(kGloveCommandChannel, [this](std::span<const std::uint8_t> message) {
    CommandHeader header;
    GloveCommand command;
    DecodeResult result = decode(message, header, command);
    const bool is_for_us = header.device == options_.device && header.glove_session == session_;
    if (result == MessageError::kNone && !is_for_us) result = MessageError::kOtherReceiver;
    if (monitor_->admit(result, {header.device, header.session, command.sequence}, clock_.now())) {
      commands_.publish({command, header.session});
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

bool LcmGloveHost::prepare(GloveState& measured) noexcept {
  if (hand_pose_) {
    // Once for each state: a newer pose would be told with the time of the older fingers.
    const bool is_joined = joined_ && joined_->sequence == measured.sequence;
    if (!is_joined && !hand_pose_->join(measured)) return false;
    if (is_joined) measured = *joined_;
    joined_ = measured;
  }
  if (options_.calibration) options_.calibration->apply(measured);
  return true;
}

bool LcmGloveHost::publish(const GloveState& state) {
  GloveState told = state;
  if (!prepare(told)) return false;
  constexpr std::chrono::milliseconds kAnnouncements{200};
  const std::chrono::nanoseconds now = clock_.now();
  if (!announced_ || now - *announced_ >= kAnnouncements) {
    announced_ = now;
    GloveInfo info{.device = options_.device,
                   .session = session_,
                   .side = options_.side,
                   .descriptor = envelope_.descriptor(),
                   .is_calibrated = options_.calibration.has_value()};
    if (hand_pose_) info.descriptor.update_rate = std::min(info.descriptor.update_rate, options_.hand_pose->rate_Hz);
    bus_->publish(kGloveInfoChannel, encode(info));
  }
  const StateHeader header{
      .device = options_.device, .session = session_, .leaseholder = monitor_->leaseholder(now), .side = options_.side};
  // What became of the command of another server, or of none, does not concern this server.
  const SafeCommand& concerned = header.leaseholder == last_session_ ? last_ : SafeCommand{};
  told.limits = concerned.reasons();
  told.command_age = concerned.age();
  told.link_delay = envelope_.link_delay();
  told.energy = concerned.energy();
  told.taken = concerned.taken();
  return bus_->publish(kGloveStateChannel, encode(header, told));
}

SafeCommand LcmGloveHost::newest_command(const GloveState& newest) noexcept {
  if (should_stop_.load(std::memory_order_relaxed)) envelope_.stop();
  GloveState measured = newest;
  if (!prepare(measured)) return {};
  measured.link_delay = std::chrono::nanoseconds(0);  // here is the envelope that limits the energy
  const Heard& heard = commands_.latest();
  last_ = envelope_.limit(heard.command, measured, clock_.now());
  last_session_ = heard.session;
  return options_.calibration ? last_.for_device(*options_.calibration) : last_;
}

LinkStatistics LcmGloveHost::statistics() const noexcept {
  return monitor_->statistics();
}

}  // namespace glissade::devices

#pragma once

/// A glove at the other end of an LCM link, as the haptic loop uses it. The glove's own end is `LcmGloveHost`.

#include <atomic>
#include <chrono>
#include <memory>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/link_statistics.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::devices {

class LinkMonitor;

struct LcmGloveOptions {
  /// How often the send thread looks for a new command. Looking costs the haptic thread nothing, whereas waking the
  /// send thread would cost it a system call for every command.
  std::chrono::nanoseconds send_period{std::chrono::microseconds(250)};
  /// After so long without an accepted state, one of any sequence is accepted: the glove may have been restarted.
  std::chrono::nanoseconds restart_silence{std::chrono::milliseconds(500)};
};

/// Receives states on the channel GLOVE_STATE and sends commands on GLOVE_COMMAND, each in a thread other than the
/// caller's. Commands are limited to the descriptor on their way out; after the last one comes, on destruction, a
/// command of no force.
class LcmGlove final : public GloveDevice {
 public:
  /// Throws std::invalid_argument when the descriptor is not valid, the bus cannot receive, or the send period is not
  /// positive.
  LcmGlove(std::shared_ptr<LcmBus> bus, DeviceDescriptor descriptor, const LcmGloveOptions& options = {});
  ~LcmGlove() override;

  const DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  bool read(GloveState& newest) noexcept override;
  void command(const GloveCommand& command) noexcept override;

  /// What came from the glove. Any thread.
  LinkStatistics statistics() const noexcept;
  /// Commands sent so far. Any thread.
  std::uint64_t commands_sent() const noexcept { return commands_sent_.load(std::memory_order_relaxed); }

 private:
  void send(const GloveCommand& command) noexcept;

  std::shared_ptr<LcmBus> bus_;
  DeviceDescriptor descriptor_;
  realtime::SteadyClock clock_;
  realtime::TripleBuffer<GloveState> states_;
  bool has_state_ = false;  ///< of the haptic thread
  realtime::TripleBuffer<GloveCommand> commands_;
  std::atomic<std::uint64_t> commands_sent_{0};
  std::unique_ptr<LinkMonitor> monitor_;
  std::unique_ptr<LcmBus::Subscription> subscription_;
  std::unique_ptr<realtime::PeriodicThread> sender_;
};

}  // namespace glissade::devices

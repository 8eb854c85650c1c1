#pragma once

/// The two ends of a glove's LCM link: `LcmGlove` for the server, i.e. the program with the haptic loop, and
/// `LcmGloveHost` for the program that drives the glove.

#include <atomic>
#include <chrono>
#include <memory>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::devices {

class LinkMonitor;

struct LcmGloveOptions {
  /// Period at which the send thread polls for a new command. Polling costs the haptic thread nothing, whereas waking
  /// the send thread would cost the haptic thread a system call for every command.
  std::chrono::nanoseconds send_period{std::chrono::microseconds(250)};
  /// Normally a state is accepted only if its sequence number is larger than that of the last accepted state. After
  /// this time without an accepted state, any sequence number is accepted, because the glove may have been restarted.
  std::chrono::nanoseconds restart_silence{std::chrono::milliseconds(500)};
};

/// The haptic loop's end of the link: receives states on the channel GLOVE_STATE and sends commands on GLOVE_COMMAND,
/// the former in the receive thread of the bus, the latter in a thread of its own. Commands are reduced to the limits
/// of the descriptor before they are sent. If any command was sent, the destructor sends a last command with zero
/// forces and torques.
class LcmGlove final : public GloveDevice {
 public:
  /// Throws std::invalid_argument when the bus is null or cannot receive, the descriptor is not valid, or the send
  /// period is not positive.
  LcmGlove(std::shared_ptr<LcmBus> bus, DeviceDescriptor descriptor, const LcmGloveOptions& options = {});
  ~LcmGlove() override;

  const DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  bool read(GloveState& newest) noexcept override;
  void command(const GloveCommand& command) noexcept override;

  /// Statistics of the messages from the glove. Any thread.
  LinkStatistics statistics() const noexcept;
  /// Commands sent so far. Any thread.
  std::uint64_t commands_sent() const noexcept { return commands_sent_.load(std::memory_order_relaxed); }

 private:
  void send(const GloveCommand& command) noexcept;

  std::shared_ptr<LcmBus> bus_;
  DeviceDescriptor descriptor_;
  realtime::SteadyClock clock_;
  realtime::TripleBuffer<GloveState> states_;
  bool has_state_ = false;  ///< used by the haptic thread only
  realtime::TripleBuffer<GloveCommand> commands_;
  std::atomic<std::uint64_t> commands_sent_{0};
  std::unique_ptr<LinkMonitor> monitor_;
  std::unique_ptr<LcmBus::Subscription> subscription_;
  std::unique_ptr<realtime::PeriodicThread> sender_;
};

struct LcmGloveHostOptions {
  /// Forces and torques of a command count as zero after this time since its arrival: the server may be gone.
  std::chrono::nanoseconds command_timeout{std::chrono::milliseconds(100)};
  /// After this time without an accepted command, any sequence number is accepted: the server may have been
  /// restarted.
  std::chrono::nanoseconds restart_silence{std::chrono::milliseconds(500)};
};

/// The glove driver's end of the link: sends states on the channel GLOVE_STATE and receives commands on GLOVE_COMMAND.
/// Thread-safety: one thread, the driver's, calls `publish` and `newest_command`.
class LcmGloveHost {
 public:
  /// Throws std::invalid_argument when the bus is null or cannot receive.
  explicit LcmGloveHost(std::shared_ptr<LcmBus> bus, const LcmGloveHostOptions& options = {});
  ~LcmGloveHost();

  /// Sends `state`; returns false when the operating system does not accept it. May block.
  bool publish(const GloveState& state);

  /// The newest command, or a default GloveCommand before the first command. Forces and torques are zero if the command
  /// arrived longer ago than `command_timeout`. Wait-free.
  GloveCommand newest_command() noexcept;

  /// Statistics of the messages from the server. Any thread.
  LinkStatistics statistics() const noexcept;

 private:
  struct ReceivedCommand {
    GloveCommand command;
    std::chrono::nanoseconds arrival{0};
  };

  std::shared_ptr<LcmBus> bus_;
  std::chrono::nanoseconds command_timeout_;
  realtime::SteadyClock clock_;
  realtime::TripleBuffer<ReceivedCommand> commands_;
  std::unique_ptr<LinkMonitor> monitor_;
  std::unique_ptr<LcmBus::Subscription> subscription_;
};

}  // namespace glissade::devices

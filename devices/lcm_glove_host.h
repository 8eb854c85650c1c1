#pragma once

/// The glove's end of an LCM link: what a driver, or `SimulatedGlove` in a process of its own, talks to.

#include <chrono>
#include <memory>

#include <glissade/devices/glove_types.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/link_statistics.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::devices {

class LinkMonitor;

struct LcmGloveHostOptions {
  /// A command older than this is no longer obeyed: the server may be gone.
  std::chrono::nanoseconds command_timeout{std::chrono::milliseconds(100)};
  /// After so long without an accepted command, one of any sequence is accepted: the server may have been restarted.
  std::chrono::nanoseconds restart_silence{std::chrono::milliseconds(500)};
};

/// Sends states on the channel GLOVE_STATE and receives commands on GLOVE_COMMAND.
/// Thread-safety: one thread, the glove's, calls `publish` and `newest_command`.
class LcmGloveHost {
 public:
  /// Throws std::invalid_argument when the bus cannot receive.
  explicit LcmGloveHost(std::shared_ptr<LcmBus> bus, const LcmGloveHostOptions& options = {});
  ~LcmGloveHost();

  /// Sends `state`; returns false when the system refused. May block.
  bool publish(const GloveState& state);

  /// The newest command, with all its forces zero once it is older than the timeout; before the first one, a default
  /// GloveCommand. Wait-free.
  GloveCommand newest_command() noexcept;

  /// What came from the server. Any thread.
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

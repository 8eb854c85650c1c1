#pragma once

/// What the wearer of a simulated glove sees: the picture of the parts that viewers show.

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>

#include <glissade/devices/lcm_bus.h>
#include <glissade/realtime/clock.h>

namespace glissade::devices {

/// Listens to the channel HAPTIC_STATE.
class WearersView {
 public:
  explicit WearersView(const std::shared_ptr<LcmBus>& bus);

  /// How long ago the hands were where the visible parts follow them; none before the first state. Wait-free. Any
  /// thread.
  std::optional<std::chrono::nanoseconds> age() const noexcept;

 private:
  realtime::SteadyClock clock_;
  std::atomic<std::chrono::nanoseconds> answered_{std::chrono::nanoseconds(0)};  // 0: nothing yet
  std::unique_ptr<LcmBus::Subscription> subscription_;
};

/// The pace (0 to 1) of a wearer whose hand gets answers of such an age. People slow down when what they see and feel
/// lags behind their hand, and stop when it stands still: as fast as the force of old contacts fades. After three
/// seconds, they give up waiting.
double pace_for(std::chrono::nanoseconds age) noexcept;

}  // namespace glissade::devices

#include <utility>

#include <glissade/devices/haptic_state.h>

#include "lcm/checked_bus.h"
#include "lcm/haptic_state_message.h"

namespace glissade::devices {

HapticStatePublisher::HapticStatePublisher(std::shared_ptr<LcmBus> bus, Listener listener, std::size_t capacity)
    : bus_(checked_bus(std::move(bus), "A publisher of haptic states")),
      listener_(std::move(listener)),
      ring_(capacity) {
  constexpr std::chrono::milliseconds kPeriod(5);  // a delay that no viewer sees, shorter than a frame
  thread_ = std::make_unique<realtime::PeriodicThread>(
      clock_, realtime::PeriodicThreadOptions{.period = kPeriod, .name = "publisher"},
      [this](const realtime::PeriodicTick&) {
        publish_all();
        return true;
      });
}

HapticStatePublisher::~HapticStatePublisher() {
  thread_->stop();
  publish_all();
}

// A state that cannot be sent is lost: viewers can do without a tick.
void HapticStatePublisher::publish_all() noexcept {
  for (HapticState state; ring_.pop(state);) {
    try {
      if (listener_) listener_(state);
      bus_->publish(kHapticStateChannel, encode(state));
    } catch (...) {  // NOLINT(bugprone-empty-catch): a lost message is no reason to end the thread
    }
  }
}

}  // namespace glissade::devices

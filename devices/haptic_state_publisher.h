#pragma once

/// Publishes the state of every tick, i.e. of every cycle of the 1 kHz haptic loop, on the LCM channel HAPTIC_STATE
/// without delaying the loop. Viewers and recorders listen to this channel.

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>

namespace glissade::devices {

/// The haptic thread, i.e. the thread of the haptic loop, fills a ring buffer. A second thread, which the publisher
/// starts, sends the contents and calls the listener with every state.
class HapticStatePublisher {
 public:
  static constexpr std::size_t kDefaultCapacity = 1024;  ///< the states of about one second

  using Listener = std::function<void(const HapticState&)>;

  /// `listener` may be empty. The publisher's thread calls it with each state, even if the state cannot be sent. Throws
  /// std::invalid_argument when the bus is null or `capacity` is 0.
  explicit HapticStatePublisher(std::shared_ptr<LcmBus> bus, Listener listener = {},
                                std::size_t capacity = kDefaultCapacity);
  /// Publishes the states still in the ring.
  ~HapticStatePublisher();

  /// Haptic thread: queues `state` and returns true. If the ring is full, drops and counts the state, and returns
  /// false. Wait-free.
  bool push(const HapticState& state) noexcept { return ring_.push(state); }

  /// States dropped so far. Any thread.
  std::uint64_t dropped() const noexcept { return ring_.dropped(); }

 private:
  void publish_all() noexcept;

  std::shared_ptr<LcmBus> bus_;
  Listener listener_;
  realtime::SteadyClock clock_;
  realtime::SpscRing<HapticState> ring_;
  std::unique_ptr<realtime::PeriodicThread> thread_;
};

}  // namespace glissade::devices

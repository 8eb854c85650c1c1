#pragma once

/// The way of a sample, from its measurement in the glove to the force at the glove, and how long its stages take.

#include <chrono>
#include <cstdint>

#include <glissade/realtime/latency_histogram.h>

namespace glissade::apps {

/// Moments on the monotonic clock of the machine, which all its processes share.
struct WayStamps {
  std::chrono::nanoseconds measured{0};     ///< `GloveState::time`
  std::chrono::nanoseconds received{0};     ///< the haptic loop may read the sample
  std::chrono::nanoseconds read{0};         ///< a tick starts and reads it
  std::chrono::nanoseconds handed_over{0};  ///< the tick gives its command to the device
  std::chrono::nanoseconds arrived{0};      ///< the driver of the glove may take the command
};

/// The stages of many ways. Those of one way add up to its whole.
struct LatencyStages {
  realtime::LatencyHistogram transport;    ///< measured to received
  realtime::LatencyHistogram wait;         ///< received to read: for the next tick
  realtime::LatencyHistogram computation;  ///< read to handed over
  realtime::LatencyHistogram way_back;     ///< handed over to arrived
  realtime::LatencyHistogram whole;
  std::uint64_t lost = 0;  ///< samples whose command did not arrive

  void record(const WayStamps& way) noexcept;
};

}  // namespace glissade::apps

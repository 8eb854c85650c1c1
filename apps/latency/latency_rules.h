#pragma once

/// What all threads of a measurement of latencies have in common.

#include <chrono>

namespace glissade::apps {

/// Of the haptic loop and of the bare loop.
inline constexpr std::chrono::nanoseconds kLatencyTick{std::chrono::milliseconds(1)};

/// Of the glove, which drifts against the loop: in a third of a second its samples fall on every moment of a tick.
inline constexpr std::chrono::nanoseconds kLatencyGlovePeriod{std::chrono::microseconds(1003)};

}  // namespace glissade::apps

#pragma once

/// What all threads of a measurement of latencies have in common.

#include <chrono>

namespace glissade::apps {

/// SCHED_FIFO priority that the haptic loop, the bare loop, the glove and the ping-pong ask for.
inline constexpr int kLatencyFifoPriority = 80;

/// Of the haptic loop and of the bare loop.
inline constexpr std::chrono::nanoseconds kLatencyTick{std::chrono::milliseconds(1)};

/// Of the glove, which drifts against the loop: in a third of a second its samples fall on every moment of a tick.
inline constexpr std::chrono::nanoseconds kLatencyGlovePeriod{std::chrono::microseconds(1003)};

}  // namespace glissade::apps

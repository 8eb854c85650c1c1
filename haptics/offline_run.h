#pragma once

/// The whole system on a simulated clock and in one thread: glove, simulation and haptic kernel take turns, a
/// millisecond each. The same inputs give the same bits.

#include <chrono>
#include <cstdint>
#include <functional>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/sliding.h>

namespace glissade::haptics {

/// One tick of the haptic loop: the rate force-feedback devices expect.
inline constexpr std::chrono::milliseconds kTickPeriod{1};

/// Runs `ticks` milliseconds and hands each to `sink`. As in real time, a tick works with the contact set of the ghost
/// one tick before.
void run_offline(devices::SimulatedGlove& glove, Sliding& sliding, HapticKernel& kernel, std::int64_t ticks,
                 const std::function<void(const devices::HapticState&)>& sink);

}  // namespace glissade::haptics

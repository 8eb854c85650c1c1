#pragma once

/// The whole system on a simulated clock and in one thread: gloves, haptic kernel and simulation take turns, once per
/// tick. The same inputs give the same bits.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/multi_part_sliding.h>
#include <glissade/haptics/recording.h>

namespace glissade::haptics {

/// A simulated glove of an offline run, and the part that its hand grasps at the first tick.
struct HandOffline {
  devices::SimulatedGlove* device = nullptr;
  std::optional<std::size_t> part = 0;  ///< number of the part in the simulation
};

struct OfflineRunOptions {
  std::chrono::nanoseconds period = kTickPeriod;
  /// Called before each tick, with its number, from 1 on: for grasps and releases.
  std::function<void(std::int64_t tick, HoldRequests& requests)> before_tick{};
  LoopObserver* observer = nullptr;  ///< null: none
};

/// Runs `ticks` ticks and passes the state of each tick to `sink`. A tick uses the contact set that answers the ghost
/// poses of the previous tick. Hands, parts and couplings are as in `HapticServer`. Throws std::invalid_argument for a
/// null glove, an empty sink or a period out of the bounds of `validate_tick_period`, and as the constructor of
/// `HapticKernel` does.
void run_offline(const std::vector<HandOffline>& hands, MultiPartSliding& sliding, std::int64_t ticks,
                 const std::function<void(const devices::HapticState&)>& sink, const OfflineRunOptions& options = {});

}  // namespace glissade::haptics

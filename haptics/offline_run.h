#pragma once

/// The whole system on a simulated clock and in one thread: glove, haptic kernel and simulation take turns, once per
/// tick. The same inputs give the same bits.

#include <chrono>
#include <cstdint>
#include <functional>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::haptics {

/// Runs `ticks` ticks of `period` and passes the state of each tick to `sink`. A tick uses the
/// contact set that answers the ghost pose of the previous tick. The hand grasps the part at the first tick; the part
/// stays where it is. The coupling is the result of `coupling_for` with the descriptor of the glove and the stiffness
/// of the simulation. Throws std::invalid_argument for an empty sink or a period out of the bounds of
/// `validate_tick_period`, and as `coupling_for` does.
void run_offline(devices::SimulatedGlove& glove, SlidingSimulation& simulation, std::int64_t ticks,
                 const std::function<void(const devices::HapticState&)>& sink,
                 std::chrono::nanoseconds period = kTickPeriod);

}  // namespace glissade::haptics

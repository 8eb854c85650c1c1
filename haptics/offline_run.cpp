#include <stdexcept>

#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/offline_run.h>

#include "loop/haptic_sample.h"

namespace glissade::haptics {

void run_offline(devices::SimulatedGlove& glove, SlidingSimulation& simulation, std::int64_t ticks,
                 const std::function<void(const devices::HapticState&)>& sink, std::chrono::nanoseconds period) {
  validate_tick_period(period);
  if (!sink) throw std::invalid_argument("an offline run needs a sink for its states, not an empty function");
  HapticKernel kernel(simulation.part(), simulation.stiffness(), glove.descriptor(), simulation.result().X_WV, period);
  devices::SafeCommand command;
  std::vector<std::int32_t> scratch;
  ContactSet set;
  set.X_WV = simulation.result().X_WV;
  for (std::int64_t i = 1; i <= ticks; ++i) {
    const std::chrono::nanoseconds now = i * period;
    const devices::GloveState state = glove.step(period, command);
    const HapticTick tick = kernel.tick(state, set, now);
    command = tick.command;
    sink(make_sample(tick, set, state, now));
    simulation.advance(tick.X_WG, std::chrono::duration<double, std::milli>(period).count());
    set = make_contact_set(simulation.result(), simulation.part(), i, now, scratch);
  }
}

}  // namespace glissade::haptics

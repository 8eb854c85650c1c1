#include <glissade/haptics/haptic_sample.h>
#include <glissade/haptics/offline_run.h>

namespace glissade::haptics {

void run_offline(devices::SimulatedGlove& glove, Sliding& sliding, HapticKernel& kernel, std::int64_t ticks,
                 const std::function<void(const devices::HapticState&)>& sink) {
  devices::GloveCommand command;
  std::vector<std::int32_t> scratch;
  ContactSet set;
  set.X_WV = sliding.result().X_WV;
  for (std::int64_t i = 1; i <= ticks; ++i) {
    const std::chrono::nanoseconds now = i * kTickPeriod;
    const devices::GloveState state = glove.step(kTickPeriod, command);
    const HapticTick tick = kernel.tick(state, set);
    command = tick.command;
    sink(make_sample(tick, set, state.X_WH.translation(), now));
    sliding.advance(tick.X_WG);
    set = make_contact_set(sliding, i, now, scratch);
  }
}

}  // namespace glissade::haptics

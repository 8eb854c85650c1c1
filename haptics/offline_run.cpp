#include <array>
#include <stdexcept>

#include <glissade/haptics/offline_run.h>

#include "loop/answer.h"
#include "loop/haptic_sample.h"

namespace glissade::haptics {

namespace {

std::vector<KernelHand> kernel_hands(const std::vector<HandOffline>& hands) {
  std::vector<KernelHand> result;
  for (const HandOffline& hand : hands) {
    if (hand.glove == nullptr) throw std::invalid_argument("an offline run needs a glove, not a null pointer");
    result.push_back({hand.glove->descriptor(), hand.part});
  }
  return result;
}

}  // namespace

void run_offline(const std::vector<HandOffline>& hands, MultiPartSliding& sliding, std::int64_t ticks,
                 const std::function<void(const devices::HapticState&)>& sink, const OfflineRunOptions& options) {
  validate_tick_period(options.period);
  if (!sink) throw std::invalid_argument("an offline run needs a sink for its states, not an empty function");
  HapticKernel kernel(kernel_parts(sliding), kernel_hands(hands), options.period);
  Answerer answerer(sliding);
  std::vector<devices::SafeCommand> commands(hands.size());
  std::vector<devices::GloveState> states(hands.size());
  std::array<const devices::GloveState*, kMaxHands> newest{};
  ContactSet set = answerer.at_start();
  for (std::int64_t i = 1; i <= ticks; ++i) {
    const std::chrono::nanoseconds now = i * options.period;
    for (std::size_t h = 0; h < hands.size(); ++h) {
      states[h] = hands[h].glove->step(options.period, commands[h]);
      newest[h] = &states[h];
    }
    if (options.before_tick) options.before_tick(i, kernel);
    const HapticTick tick = kernel.tick({newest.data(), hands.size()}, set, now);
    for (std::size_t h = 0; h < hands.size(); ++h)
      commands[h] = tick.hands[h].command;
    sink(make_sample(i, tick, set, {newest.data(), hands.size()}, now));
    set = answerer.answer(tick.ghosts, options.period);
  }
}

}  // namespace glissade::haptics

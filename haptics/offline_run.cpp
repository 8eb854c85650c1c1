#include <stdexcept>

#include <glissade/haptics/offline_run.h>

#include "loop/answer.h"
#include "loop/kernel_hands.h"
#include "loop/run_tick.h"

namespace glissade::haptics {

void run_offline(const std::vector<HandInLoop<devices::SimulatedGlove>>& hands, grasping::GraspSimulation& simulation,
                 std::int64_t ticks, const std::function<void(const devices::HapticState&)>& sink,
                 const OfflineRunOptions& options) {
  validate_tick_period(options.period);
  if (!sink) throw std::invalid_argument("an offline run needs a sink for its states, not an empty function");
  HapticKernel kernel(kernel_parts(simulation.parts()), kernel_hands(hands, simulation), options.period);
  Answerer answerer(simulation);
  TickRecord record;
  record.hand_count = static_cast<std::int32_t>(hands.size());
  AnswerRecord answer;
  answer.set = answerer.at_start();
  for (std::int64_t i = 1; i <= ticks; ++i) {
    record.number = record.sequence = i;
    record.time = record.deadline = i * options.period;
    for (std::size_t h = 0; h < hands.size(); ++h) {
      record.states[h] = hands[h].device->step(options.period, record.tick.hands[h].command);
      record.has_state[h] = record.states[h].sequence > 0;  // one that was measured
    }
    record.requests.clear();
    if (options.before_tick) options.before_tick(i, record.requests);
    run_tick(kernel, record, answer.set);
    sink(record.state);
    answer.ghosts = record.tick.ghosts;
    answerer.answer(answer.ghosts, options.period, answer.set);
    if (options.observer == nullptr) continue;
    options.observer->after_tick(record);
    options.observer->after_answer(answer);
  }
}

}  // namespace glissade::haptics

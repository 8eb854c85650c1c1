#include "loop/run_tick.h"

#include <array>
#include <span>

#include "loop/haptic_sample.h"

namespace glissade::haptics {

void run_tick(HapticKernel& kernel, TickRecord& record, const ContactSet& set) noexcept {
  const auto hand_count = static_cast<std::size_t>(record.hand_count);
  std::array<const devices::GloveState*, hands::kMaxHands> newest{};
  for (std::size_t h = 0; h < hand_count; ++h)
    newest[h] = record.has_state[h] ? &record.states[h] : nullptr;
  const std::span<const devices::GloveState* const> states{newest.data(), hand_count};

  if (record.is_stopped) kernel.stop();
  for (const HoldRequest& request : record.requests.all()) {
    const auto hand = static_cast<std::size_t>(request.hand);
    if (request.part < 0) {
      kernel.release(hand);
    } else {
      kernel.grasp(hand, static_cast<std::size_t>(request.part));
    }
  }
  record.set_sequence = set.sequence;
  record.part_count = set.part_count;
  record.tick = kernel.tick(states, set, record.time);
  if (record.sequence > 0) record.state = make_sample(record, set, states);
}

}  // namespace glissade::haptics

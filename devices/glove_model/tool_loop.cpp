#include "glove_model/tool_loop.h"

#include <algorithm>

namespace glissade::devices {
namespace {

constexpr std::chrono::duration<double> kReturn(0.2);  // promise 4 of docs/safety.md

}  // namespace

ToolLoop::ToolLoop(const WristModel& wrist, std::chrono::nanoseconds start)
    : period_(nanoseconds_of(1.0 / wrist.loop_rate)),
      delay_(nanoseconds_of(wrist.loop_delay)),
      next_(start),
      on_the_way_(delay_line_capacity(wrist.loop_delay, wrist.loop_rate)) {}

const HandWrench& ToolLoop::advance(const GloveState& hand, const HalfSpaces& half_spaces,
                                    std::chrono::nanoseconds age) noexcept {
  if (hand.time >= next_) {
    next_ += period_;
    share_ = age > half_spaces.expiry ? 0.0 : std::min(1.0, share_ + period_ / kReturn);
    HandWrench wrench = half_space_wrench(half_spaces, hand.X_WH, hand.v_WH, hand.w_WH);
    wrench.f_H_W *= share_;
    wrench.t_H_W *= share_;
    on_the_way_.push(wrench, hand.time + delay_);
  }
  on_the_way_.take(hand.time, exerted_);
  return exerted_;
}

}  // namespace glissade::devices

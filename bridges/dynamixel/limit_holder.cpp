#include "dynamixel/limit_holder.h"

#include <cmath>
#include <numbers>

namespace glissade::bridges::dynamixel {
namespace {

// A finger turns by less than 20 rad/s, so it takes more than a period of 2 ms from ready to the limit.
constexpr double kReady_rad = 3.0 * std::numbers::pi / 180.0;
constexpr double kOff_rad = 5.0 * std::numbers::pi / 180.0;

}  // namespace

LimitHolder::LimitHolder(double play) noexcept : play_(play) {}

/// `inside` (rad) is the distance to the nearer limit; negative beyond it.
LimitHolder::State LimitHolder::next_state(double inside) const noexcept {
  if (inside > kOff_rad + play_) return State::kOff;
  if (inside > kReady_rad + play_ && state_ == State::kOff) return State::kOff;
  if (inside > play_) return State::kReady;
  if (inside > 0.5 * play_ && state_ != State::kHolding) return State::kReady;
  return State::kHolding;
}

HoldGoal LimitHolder::update(const devices::JointLimit& limit, double angle) noexcept {
  if (!(limit.max_torque > 0.0) || !std::isfinite(angle)) {
    reset();
    return {};
  }
  const bool is_upper = limit.upper - angle <= angle - limit.lower;
  state_ = next_state(is_upper ? limit.upper - angle : angle - limit.lower);
  if (state_ == State::kOff) return {};
  return {.has_torque = true,
          .angle = is_upper ? limit.upper : limit.lower,
          .max_torque = state_ == State::kHolding ? limit.max_torque : 0.0,
          .stiffness = limit.stiffness};
}

}  // namespace glissade::bridges::dynamixel

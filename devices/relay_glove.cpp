#include <chrono>

#include <glissade/devices/relay_glove.h>

namespace glissade::devices {

namespace {

constexpr double kPatiencePeriods = 6.0;             // a command has waited for both threads
constexpr std::chrono::milliseconds kLoopPeriod{1};  // a faster glove waits for the haptic loop
constexpr std::int64_t kNoState = -1;

}  // namespace

RelayGlove::RelayGlove(const DeviceDescriptor& descriptor, const realtime::Clock* clock)
    : clock_(clock != nullptr ? *clock : steady_clock_), envelope_(descriptor, kPatiencePeriods, kLoopPeriod) {
  descriptor_ = envelope_.descriptor();
  state_.sequence = kNoState;
}

void RelayGlove::publish(const GloveState& measured) noexcept {
  const std::int64_t sequence = state_.sequence + 1;
  state_ = measured;
  state_.sequence = sequence;
  state_.obeys_another = false;
  state_.limits = last_.reasons();
  state_.command_age = last_.age();
  state_.link_delay = envelope_.link_delay();
  state_.energy = last_.energy();
  state_.taken = last_.taken();
  states_.publish(state_);
}

SafeCommand RelayGlove::newest_command() noexcept {
  if (state_.sequence == kNoState) return {};
  if (should_stop_.load(std::memory_order_relaxed)) envelope_.stop();
  GloveState measured = state_;
  measured.link_delay = std::chrono::nanoseconds(0);  // here is the envelope that limits the energy
  last_ = envelope_.limit(commands_.latest().values(), measured, clock_.now());
  return last_;
}

bool RelayGlove::read(GloveState& newest) noexcept {
  has_state_ = states_.update() || has_state_;
  if (has_state_) newest = states_.value();
  return has_state_;
}

}  // namespace glissade::devices

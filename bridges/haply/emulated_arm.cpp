#include "haply/emulated_arm.h"

#include <algorithm>
#include <utility>

namespace glissade::bridges {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// Only an envelope makes a command. This one is to stand in the way of none that a bridge sends.
devices::DeviceDescriptor without_limits(devices::DeviceDescriptor descriptor) {
  constexpr double kMuch = 1e6;
  descriptor.max_force_rate = kMuch;
  descriptor.max_power = kMuch;
  return descriptor;
}

}  // namespace

double OscillationGate::pass(const Eigen::Vector3d& force, nanoseconds now, double gain) {
  constexpr milliseconds kWindow{250};
  constexpr int kTurns = 5;  // 10 Hz and more
  if (now - window_start_ > kWindow) {
    is_closed_ = turns_ >= kTurns;
    turns_ = 0;
    window_start_ = now;
  }
  if (force.dot(last_) < 0.0) ++turns_;
  if (!force.isZero(0.0)) last_ = force;
  return is_closed_ ? 1.0 - gain : 1.0;
}

EmulatedArm::EmulatedArm(devices::SimulatedGlove hand, const HaplyFilters& filters, nanoseconds now)
    : hand_(std::move(hand)), envelope_(without_limits(hand_.descriptor())), filters_(filters), last_(now) {}

void EmulatedArm::advance(nanoseconds now, const Eigen::Vector3d& f_C_D, double damping_N_s_per_m, bool goes_on) {
  constexpr nanoseconds kLongest = milliseconds(20);  // a thread that was held up makes no leap
  const nanoseconds dt = std::min(now - std::exchange(last_, now), kLongest);
  const devices::GloveState& state = hand_.true_state();
  exerted_ =
      filters_.force_scale * (gate_.pass(f_C_D, now, filters_.force_gate) * f_C_D - damping_N_s_per_m * state.v_WH);
  devices::GloveCommand command;
  command.sequence = ++commands_;
  command.state_sequence = state.sequence;
  command.state_time = state.time;
  command.f_H_W = exerted_;
  hand_.step(dt, envelope_.limit(command, state, state.time), goes_on ? 1.0 : 0.0);
}

}  // namespace glissade::bridges

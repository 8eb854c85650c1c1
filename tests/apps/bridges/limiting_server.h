#pragma once

/// A server that stops one joint of a glove, and what tests wait for.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <thread>
#include <utility>

#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/clock.h>

#include "glissade_program.h"

namespace glissade::apps {

/// Answers each state of the glove with a limit of the joint, in the middle of its way.
class LimitingServer {
 public:
  LimitingServer(devices::DeviceDescriptor descriptor, std::size_t joint)
      : descriptor_(std::move(descriptor)),
        joint_(joint),
        thread_([this](const std::stop_token& stop) { serve(stop); }) {}

  /// Says nothing more, as if it were killed: without the last command of a server that ends.
  void fall_silent() { is_silent_ = true; }

 private:
  void serve(const std::stop_token& stop) {
    devices::LcmGlove glove(std::make_shared<devices::LcmBus>(test_support::kUrl), descriptor_);
    devices::SafetyEnvelope envelope(descriptor_);
    realtime::SteadyClock clock;
    for (std::int64_t sequence = 1; !stop.stop_requested(); ++sequence) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      devices::GloveState state;
      if (is_silent_ || !glove.read(state)) continue;
      devices::GloveCommand wanted;
      wanted.sequence = sequence;
      wanted.state_sequence = state.sequence;
      wanted.state_time = state.time;
      wanted.time = clock.now();
      wanted.joint_limits.joints[joint_] = {.upper = 0.5 * descriptor_.joint_upper[joint_],
                                            .stiffness = descriptor_.max_limit_stiffness,
                                            .max_torque = descriptor_.max_joint_torque};
      glove.command(envelope.limit(wanted, state, clock.now()));
    }
  }

  devices::DeviceDescriptor descriptor_;
  std::size_t joint_;
  std::atomic<bool> is_silent_{false};
  std::jthread thread_;
};

/// How long it takes until `condition` holds, at most ten seconds.
template <typename Condition>
std::chrono::duration<double> time_until(Condition condition) {
  const auto start = std::chrono::steady_clock::now();
  while (!condition() && std::chrono::steady_clock::now() - start < std::chrono::seconds(10))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return std::chrono::steady_clock::now() - start;
}

}  // namespace glissade::apps

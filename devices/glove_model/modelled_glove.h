#pragma once

/// What a `GloveModel` adds to a simulated glove: the fingers, the loop of the arm, the measurement, and the link to
/// the server.

#include <chrono>
#include <optional>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/glove_model.h>
#include <glissade/devices/safety_envelope.h>

#include "glove_model/delay_line.h"
#include "glove_model/finger_dynamics.h"
#include "glove_model/random_numbers.h"
#include "glove_model/tool_loop.h"

namespace glissade::devices {

/// Allocates only at construction. Can be copied.
class ModelledGlove {
 public:
  /// `start` is the true state at the start, which is also the first measured state. The model must be valid.
  ModelledGlove(const GloveModel& model, const GloveState& start);

  /// Sends `newest` over the link if the device has measured since the last call. `now` is the device's time.
  void hear(const SafeCommand& newest, std::chrono::nanoseconds now) noexcept;

  /// The command that the device has, and the time when the device heard it.
  const SafeCommand& command() const noexcept { return command_; }
  std::chrono::nanoseconds heard_at() const noexcept { return heard_at_; }

  /// Measures `truth` if a measurement is due. Call this function at the end of each step.
  void measure(const GloveState& truth) noexcept;

  /// The newest state that has arrived at the server.
  const GloveState& state() const noexcept { return state_; }

  LinkLosses losses() const noexcept {
    return {lost_.states + states_.overtaken(), lost_.commands + commands_.overtaken()};
  }

  /// The loop of an arm that holds half-spaces, or null.
  ToolLoop* tool() noexcept { return tool_ ? &*tool_ : nullptr; }

  /// Fingers with dynamics, or null.
  FingerDynamics* fingers() noexcept { return fingers_ ? &*fingers_ : nullptr; }

  const GloveModel& model() const noexcept { return model_; }

 private:
  GloveState measured(const GloveState& truth) noexcept;
  std::chrono::nanoseconds link_delay() noexcept;
  bool is_lost() noexcept { return link_random_.uniform() < model_.link.loss; }

  GloveModel model_;
  std::optional<FingerDynamics> fingers_;
  std::optional<ToolLoop> tool_;
  RandomNumbers sensor_random_;
  RandomNumbers link_random_;
  hands::JointValues drifts_{};  ///< rad
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds next_;
  GloveState last_measured_;
  DelayLine<GloveState> states_;
  GloveState state_;
  DelayLine<SafeCommand> commands_;
  SafeCommand command_;
  std::chrono::nanoseconds heard_at_;
  bool has_measured_ = true;
  LinkLosses lost_;  // by chance
};

}  // namespace glissade::devices

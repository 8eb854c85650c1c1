#pragma once

/// The loop of an arm that holds half-spaces by itself.

#include <chrono>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/glove_model.h>

#include "glove_model/delay_line.h"

namespace glissade::devices {

/// Measures the hand once a period, and exerts the wrench of the half-spaces after a delay. Half-spaces that have not
/// been renewed within their expiry exert nothing; then the force returns within 200 ms.
class ToolLoop {
 public:
  /// `start` is the device's time.
  ToolLoop(const WristModel& wrist, std::chrono::nanoseconds start);

  /// The wrench at the time of `hand`. The half-spaces were heard `age` ago.
  const HandWrench& advance(const GloveState& hand, const HalfSpaces& half_spaces,
                            std::chrono::nanoseconds age) noexcept;

 private:
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds delay_;
  std::chrono::nanoseconds next_;
  double share_ = 1.0;  // of the wrench
  DelayLine<HandWrench> on_the_way_;
  HandWrench exerted_;
};

}  // namespace glissade::devices

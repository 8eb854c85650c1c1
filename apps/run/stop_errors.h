#pragma once

/// How far from the surface of an object the device stops the fingers of a simulated glove.

#include <array>
#include <cstdint>

#include <glissade/devices/haptic_state.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/hands/hand.h>

namespace glissade::apps {

/// The difference between the true angle of a joint and its angle in the visible hand, for joints that press while the
/// hand holds a part and has come to rest.
class StopErrors {
 public:
  /// After each tick, the state of the loop and the glove of the first hand.
  void note(const devices::HapticState& state, const devices::SimulatedGlove& glove) noexcept;

  struct Figures {
    std::int64_t joints = 0;    ///< that have pressed for a second or longer
    double mean_deg = 0.0;      ///< over these joints and their time
    double greatest_deg = 0.0;  ///< greatest mean of a joint over its time
  };
  Figures figures() const noexcept;

 private:
  struct Sum {
    std::int64_t ticks = 0;
    double deg = 0.0;
  };

  std::array<Sum, hands::kJoints> sums_{};
  std::int64_t held_ticks_ = 0;  // since the hand took hold
};

}  // namespace glissade::apps

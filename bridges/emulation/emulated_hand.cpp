#include "emulation/emulated_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glissade/bridges/finger_values.h>

namespace glissade::bridges {

hands::JointValues busy_wearer(std::chrono::nanoseconds time) {
  constexpr double kPeriod_s = 4.0;
  constexpr double kLag_s = 0.1;
  constexpr double kMost = 0.9;
  const double time_s = std::chrono::duration<double>(time).count();
  FingerValues curls{};
  for (std::size_t f = 0; f < kFingers; ++f) {
    const double phase = std::max(0.0, time_s - kLag_s * static_cast<double>(f)) / kPeriod_s;
    curls[f] = kMost * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * phase));
  }
  return angles_of(curls);
}

EmulatedHand::EmulatedHand(const devices::GloveModel& model, EmulatedWearer wearer)
    : wearer_(wearer ? std::move(wearer) : busy_wearer), fingers_(model, wearer_(std::chrono::nanoseconds(0))) {}

void EmulatedHand::advance_to(std::chrono::nanoseconds now) {
  constexpr std::chrono::nanoseconds kStep = std::chrono::milliseconds(1);  // of the wearer
  constexpr bool kGrips = false;                                            // a relaxed hand
  while (now_ < now) {
    const std::chrono::nanoseconds dt = std::min(kStep, now - now_);
    fingers_.advance(dt, wearer_(now_), kGrips);
    now_ += dt;
  }
}

}  // namespace glissade::bridges

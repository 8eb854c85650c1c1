#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glissade/apps/run/stop_errors.h>

namespace glissade::apps {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;  // of a radian
constexpr std::int64_t kToRest = 500;                  // ticks
constexpr double kPressing_Nm = 0.05;    // more than the friction of any preset; a quarter of a usual grip
constexpr std::int64_t kCounted = 1000;  // ticks: a joint that presses for a shorter time passes by

}  // namespace

void StopErrors::note(const devices::HapticState& state, const devices::SimulatedGlove& glove) noexcept {
  const devices::HapticHandState& hand = state.hands[0];
  held_ticks_ = hand.part >= 0 ? held_ticks_ + 1 : 0;
  if (held_ticks_ <= kToRest) return;
  for (std::size_t j = 0; j < sums_.size(); ++j) {
    if (std::abs(glove.felt_torques()[j]) < kPressing_Nm) continue;
    ++sums_[j].ticks;
    sums_[j].deg += kDegrees * std::abs(glove.true_state().joint_angles[j] - hand.visible.angles[j]);
  }
}

StopErrors::Figures StopErrors::figures() const noexcept {
  Figures figures;
  Sum all;
  for (const Sum& sum : sums_) {
    if (sum.ticks < kCounted) continue;
    ++figures.joints;
    all.ticks += sum.ticks;
    all.deg += sum.deg;
    figures.greatest_deg = std::max(figures.greatest_deg, sum.deg / static_cast<double>(sum.ticks));
  }
  if (all.ticks > 0) figures.mean_deg = all.deg / static_cast<double>(all.ticks);
  return figures;
}

}  // namespace glissade::apps

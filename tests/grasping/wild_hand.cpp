#include "wild_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clasped_hand.h"
#include "poses.h"
#include "random_numbers.h"

namespace glissade::test_support {
namespace {

constexpr double kFastest = 30.0;  // rad/s
constexpr double kStart_m = 0.2;   // from the palm to the point where it comes to
const Eigen::Vector3d kPalm_R(0.085, 0.0, -0.015);

/// Between 0 and 1 with slopes of constant size.
double zigzag(double x) {
  return std::abs(std::remainder(x, 2.0));
}

}  // namespace

WildHand::WildHand(std::uint64_t seed, WildMotion motion, const geometry::TriangleMesh& object_W) : motion_(motion) {
  RandomNumbers random(seed);
  for (const grasping::FlexValue& value : hand_chain()->values()) {
    const double amplitude = 0.5 * (value.upper - value.lower);
    const double rate = random.uniform(0.1, 1.0) * kFastest / amplitude;
    swings_.push_back({value.lower + amplitude, amplitude, rate, random.uniform(-std::numbers::pi, std::numbers::pi)});
  }
  const int last = static_cast<int>(object_W.vertices.size()) - 1;
  p_W_ = object_W.vertices[static_cast<std::size_t>(random.integer(0, last))];
  q_WR_ = Eigen::Quaterniond(random.rotation());
  axis_W_ = random.direction();
  swing_rates_ = {random.uniform(20.0, 60.0), random.uniform(10.0, 40.0), random.uniform(20.0, 80.0)};
}

grasping::Posture WildHand::at_ms(int ms) const {
  const double t = 1e-3 * ms;
  const double approach = std::max(0.0, 1.0 - t / 0.06);  // 3.3 m/s
  double distance = kStart_m * approach;
  double turn = 0.0;
  switch (motion_) {
    case WildMotion::kRandom:
      distance += (1.0 - approach) * 0.04 * std::sin(swing_rates_[0] * t);
      turn = 0.5 * std::sin(swing_rates_[1] * t);
      break;
    case WildMotion::kFist:
      distance += (1.0 - approach) * 0.02 * std::sin(swing_rates_[0] * t);
      break;
    case WildMotion::kSlap:
      distance = kStart_m - 0.3 * zigzag(10.0 * t);
      break;
    case WildMotion::kTwist:
      turn = (1.0 - approach) * 1.5 * std::sin(swing_rates_[1] * std::max(0.0, t - 0.06));
      break;
  }
  grasping::Posture posture = open_hand();
  for (std::size_t v = 0; v < swings_.size(); ++v) {
    const Swing& swing = swings_[v];
    const double closed = motion_ == WildMotion::kFist    ? zigzag(0.5 * kFastest / swing.amplitude * t)
                          : motion_ == WildMotion::kTwist ? std::clamp((t - 0.04) / 0.06, 0.0, 1.0)
                                                          : 0.5 + 0.5 * std::sin(swing.rate * t + swing.phase);
    posture.values[v] = swing.middle + swing.amplitude * (2.0 * closed - 1.0);
  }
  const Eigen::Quaterniond q_turn = Eigen::Quaterniond(Eigen::AngleAxisd(turn, axis_W_));
  const Eigen::Vector3d sideways(0.02 * std::sin(swing_rates_[2] * t) * (1.0 - approach), 0.0, distance);
  posture.X_WR = pose(p_W_, q_turn * q_WR_);
  posture.X_WR.translation() += posture.X_WR.linear() * (sideways - kPalm_R);
  return posture;
}

}  // namespace glissade::test_support

#include "life/steady_fingers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::grasping {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSmoothing_ms = 20.0;
constexpr double kNoise = 6.0 * kDegree;    // three standard deviations of a noisy glove
constexpr double kMotion = 10.0 * kDegree;  // no noise is so large

}  // namespace

std::span<const double> SteadyFingers::follow(std::span<const double> values, double milliseconds) {
  const double least = 1.0 - std::exp(-milliseconds / kSmoothing_ms);
  for (std::size_t v = 0; v < values.size(); ++v) {
    const double change = values[v] - values_[v];
    const double plain = (std::abs(change) - kNoise) / (kMotion - kNoise);
    values_[v] += std::clamp(plain, least, 1.0) * change;
  }
  return values_;
}

}  // namespace glissade::grasping

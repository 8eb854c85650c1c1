#pragma once

/// A smooth step.

#include <algorithm>

namespace glissade::haptics {

/// From 1 to 0 as x goes from `low` to `high`.
inline double smoothly_down(double x, double low, double high) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

}  // namespace glissade::haptics

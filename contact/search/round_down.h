#pragma once

/// Bounds in single precision.

#include <cmath>

namespace glissade::contact {

/// The greatest number of single precision that is not above `value`.
inline float round_down(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) <= value ? rounded : std::nextafter(rounded, -1e30F);
}

/// The least number of single precision that is not below `value`.
inline float round_up(double value) {
  return -round_down(-value);
}

}  // namespace glissade::contact
